package io.troupe.player.structures.planner;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Data of the Player interface planner. This client does not use it. */
public class PlayerPlannerData {
    private byte valid;
    private byte done;
    private PlayerPose pos = new PlayerPose();
    private PlayerPose goal = new PlayerPose();
    private PlayerPose waypoint = new PlayerPose();
    private int waypoint_idx;
    private int waypoints_count;

    public synchronized byte getValid() {
        return valid;
    }

    public synchronized void setValid(byte value) {
        valid = value;
    }

    public synchronized byte getDone() {
        return done;
    }

    public synchronized void setDone(byte value) {
        done = value;
    }

    public synchronized PlayerPose getPos() {
        return pos;
    }

    public synchronized void setPos(PlayerPose2d value) {
        pos = PlayerPose.of(value);
    }

    public synchronized PlayerPose getGoal() {
        return goal;
    }

    public synchronized void setGoal(PlayerPose2d value) {
        goal = PlayerPose.of(value);
    }

    public synchronized PlayerPose getWaypoint() {
        return waypoint;
    }

    public synchronized void setWaypoint(PlayerPose2d value) {
        waypoint = PlayerPose.of(value);
    }

    public synchronized int getWaypoint_idx() {
        return waypoint_idx;
    }

    public synchronized void setWaypoint_idx(int value) {
        waypoint_idx = value;
    }

    public synchronized int getWaypoints_count() {
        return waypoints_count;
    }

    public synchronized void setWaypoints_count(int value) {
        waypoints_count = value;
    }
}
