package io.troupe.sim;

import io.troupe.sim.device.Blobfinder;
import io.troupe.sim.device.Sonar;

/**
 * The current state of the world, without copies: the numbers of a {@link Snapshot}, one by one.
 *
 * <p><b>Role.</b> For controllers in a loop of many intervals: no accessor allocates. There is one object, which always
 * shows the newest tick; {@link #snapshot} makes a lasting copy.
 *
 * <p><b>Threads.</b> The thread that advances the world, between intervals.
 *
 * <p><b>Units and shapes.</b> As in {@link RobotReading}, {@link io.troupe.sim.device.Odometry} and
 * {@link io.troupe.sim.device.ColourBlob}; robots, sonars, rangers, readings, blobs and contacts count from 0.
 *
 * <p><b>Errors.</b> {@link IndexOutOfBoundsException} for a robot, sonar, ranger, blob or contact that does not exist;
 * {@link #sonarCount} is 0 for a robot without sonar, as is {@link #blobCount} without blobfinder.
 */
public final class WorldView {
    private final World world;

    WorldView(World world) {
        this.world = world;
    }

    public long tick() {
        return world.tick();
    }

    /** Simulated time. */
    public long timeMicros() {
        return world.tick() * world.intervalMicros();
    }

    public int robotCount() {
        return world.spec().robots().size();
    }

    /** True while a robot is out of the world. */
    public boolean isAway(int robot) {
        return world.isAway(robot);
    }

    /** True while an obstacle of the world's specification is in the world. */
    public boolean holdsObstacle(int obstacle) {
        return world.holdsObstacle(obstacle);
    }

    public double x(int robot) {
        return world.physics().x(robot);
    }

    public double y(int robot) {
        return world.physics().y(robot);
    }

    public double headingRad(int robot) {
        return world.physics().headingRad(robot);
    }

    public double odometryX(int robot) {
        return world.devices(robot).position2d().x();
    }

    public double odometryY(int robot) {
        return world.devices(robot).position2d().y();
    }

    public double odometryHeadingRad(int robot) {
        return world.devices(robot).position2d().headingRad();
    }

    /** Speed that was in force in the interval that has ended. */
    public double forwardMps(int robot) {
        return world.forwardMps(robot);
    }

    /** Speed to the left that was in force in the interval that has ended. */
    public double sidewaysMps(int robot) {
        return world.sidewaysMps(robot);
    }

    /** Turn rate that was in force in the interval that has ended. */
    public double turnRadps(int robot) {
        return world.turnRadps(robot);
    }

    public boolean stalled(int robot) {
        return world.physics().stalled(robot);
    }

    /** Distance from the body's edge to the nearest obstacle. Costs one distance computation for each wall nearby. */
    public double wallGapM(int robot) {
        return world.scene().wallGapM(robot);
    }

    /**
     * Number of sonars of the robot: those of its {@code sonar} or, without one, the sensors of its first
     * {@code ranger} whose sensors cast one ray each (dialect of Stage 4).
     */
    public int sonarCount(int robot) {
        SimulatedDevices devices = world.devices(robot);
        Sonar sonar = devices.sonar();
        if (sonar != null) {
            return sonar.count();
        }
        int ring = devices.sonarRanger();
        return ring < 0 ? 0 : devices.rangersM().get(ring).length;
    }

    /** Range of a sonar, numbered as {@link #sonarCount} counts. */
    public double rangeM(int robot, int sonar) {
        SimulatedDevices devices = world.devices(robot);
        Sonar classic = devices.sonar();
        if (classic != null) {
            return classic.rangeM(sonar);
        }
        int ring = devices.sonarRanger();
        if (ring < 0) {
            throw new IndexOutOfBoundsException("robot " + robot + " has no sonar");
        }
        return rangeM(robot, ring, sonar);
    }

    /** Number of lasers and rangers of the robot, in the order of {@link RobotReading}. */
    public int rangerCount(int robot) {
        return world.devices(robot).rangersM().size();
    }

    /** Number of readings of a laser or ranger, for all its sensors together. */
    public int rangeCount(int robot, int ranger) {
        return world.devices(robot).rangersM().get(ranger).length;
    }

    /** A reading of a laser or ranger, counted from the right end of its first sensor. */
    public double rangeM(int robot, int ranger, int reading) {
        return world.devices(robot).rangersM().get(ranger)[reading];
    }

    public int blobCount(int robot) {
        Blobfinder blobfinder = world.devices(robot).blobfinder();
        return blobfinder == null ? 0 : blobfinder.count();
    }

    public int blobColour(int robot, int blob) {
        return seen(robot, blob).colour(blob);
    }

    public int blobLeft(int robot, int blob) {
        return seen(robot, blob).left(blob);
    }

    public int blobRight(int robot, int blob) {
        return seen(robot, blob).right(blob);
    }

    public int blobTop(int robot, int blob) {
        return seen(robot, blob).top(blob);
    }

    public int blobBottom(int robot, int blob) {
        return seen(robot, blob).bottom(blob);
    }

    public double blobRangeM(int robot, int blob) {
        return seen(robot, blob).rangeM(blob);
    }

    private Blobfinder seen(int robot, int blob) {
        Blobfinder blobfinder = world.devices(robot).blobfinder();
        if (blobfinder == null || blob < 0 || blob >= blobfinder.count()) {
            throw new IndexOutOfBoundsException(
                    "there is no blob " + blob + ", robot " + robot + " sees " + blobCount(robot));
        }
        return blobfinder;
    }

    /** Number of contacts that began in the interval that has ended. */
    public int contactCount() {
        return world.physics().touches().count();
    }

    public long contactTimeMicros(int contact) {
        return world.physicsStartMicros() + world.physics().touches().timeMicros(contact(contact));
    }

    /** Index of the robot; of two robots the lower index. */
    public int contactRobot(int contact) {
        return world.physics().touches().robot(contact(contact));
    }

    /** Index of the other robot, or -1 if it is an obstacle. */
    public int contactOtherRobot(int contact) {
        return world.physics().touches().otherRobot(contact(contact));
    }

    /** Index of the obstacle in the world's specification, or -1 if it is a robot. */
    public int contactObstacle(int contact) {
        return world.physics().touches().obstacle(contact(contact));
    }

    private int contact(int contact) {
        return java.util.Objects.checkIndex(contact, contactCount());
    }

    /** As {@link World#command} for the next interval; replaces earlier commands of other threads. */
    public void command(int robot, double forwardMps, double turnRadps) {
        world.commandNow(robot, forwardMps, turnRadps);
    }

    /** A copy of the current state, which is not published. */
    public Snapshot snapshot() {
        return world.snapshot();
    }
}
