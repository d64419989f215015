package io.troupe.player.structures.planner;

import io.troupe.player.structures.PlayerPose;

/** A request of the Player interface planner. This client does not use it. */
public class PlayerPlannerWaypointsReq {
    private int waypoints_count;
    private PlayerPose[] waypoints = new PlayerPose[0];

    public synchronized int getWaypoints_count() {
        return waypoints_count;
    }

    public synchronized void setWaypoints_count(int value) {
        waypoints_count = value;
    }

    public synchronized PlayerPose[] getWaypoints() {
        return waypoints;
    }

    public synchronized void setWaypoints(PlayerPose[] value) {
        waypoints = value;
    }
}
