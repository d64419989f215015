package io.troupe.player;

import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.structures.planner.PlayerPlannerData;
import io.troupe.player.structures.planner.PlayerPlannerWaypointsReq;

/**
 * A path planner. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface planner.
 */
public class PlannerInterface extends UnofferedDevice {
    public PlannerInterface(PlayerClient client) {
        super(client, "planner");
    }

    public void setGoal(PlayerPose2d goal) {
        throw notOffered();
    }

    public void getWaypoints() {
        throw notOffered();
    }

    public void setRobotMotion(int state) {
        throw notOffered();
    }

    public PlayerPlannerData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public PlayerPlannerWaypointsReq getWaypointData() {
        throw notOffered();
    }

    public boolean isReadyWaypointData() {
        throw notOffered();
    }
}
