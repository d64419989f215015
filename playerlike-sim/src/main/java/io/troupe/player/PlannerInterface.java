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
public class PlannerInterface extends UnsupportedDevice {
    public PlannerInterface(PlayerClient client) {
        super(client, "planner");
    }

    public void setGoal(PlayerPose2d goal) {
        throw notSupported();
    }

    public void getWaypoints() {
        throw notSupported();
    }

    public void setRobotMotion(int state) {
        throw notSupported();
    }

    public PlayerPlannerData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public PlayerPlannerWaypointsReq getWaypointData() {
        throw notSupported();
    }

    public boolean isReadyWaypointData() {
        throw notSupported();
    }
}
