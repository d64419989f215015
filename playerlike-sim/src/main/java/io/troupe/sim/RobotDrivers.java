package io.troupe.sim;

/**
 * Counts the clients that may drive each robot of a simulation, and stops a robot when the last one has left: no robot
 * keeps the speed of a client that is gone. (A client that is there and silent is stopped by its command limit or by
 * the watchdog, in {@link RobotCommands}.)
 *
 * <p><b>Threads.</b> Under the lock of the simulation.
 */
final class RobotDrivers {
    private final World world;
    private final int[] drivers;

    RobotDrivers(World world) {
        this.world = world;
        drivers = new int[world.spec().robots().size()];
    }

    /** A client has subscribed to the wheels of a robot. */
    void joined(int robot) {
        drivers[robot]++;
    }

    /** A client has unsubscribed from the wheels of a robot, or its connection has ended. */
    void left(int robot) {
        drivers[robot]--;
        if (drivers[robot] == 0) {
            world.stop(robot);
        }
    }
}
