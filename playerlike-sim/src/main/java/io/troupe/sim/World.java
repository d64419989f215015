package io.troupe.sim;

import io.troupe.sim.device.Blobfinder;
import io.troupe.sim.device.Clearance;
import io.troupe.sim.device.Odometer;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.RayGrid;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicReferenceArray;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * A world of robots that advances by fixed intervals of simulated time.
 *
 * <p><b>Role.</b> Made from a {@link WorldSpec}; {@link Simulation} offers its robots to Player clients.
 * <p><b>Threads.</b> {@link #advance} always on the same thread; commands and {@link #latest} on any.
 * <p><b>Order.</b> One interval: the newest commands are latched in the order of robots; physics steps; then everything is sensed, in the order of robots.
 * The same settings and commands give the same snapshots, bit for bit, on any machine.
 * <p><b>Units and shapes.</b> SI; simulated time in microseconds.
 */
public final class World {
    private record Command(double forwardMps, double turnRadps) {
        static final Command STOP = new Command(0, 0);
    }

    private final WorldSpec spec;
    private final WorldSettings settings;
    private final Physics physics;
    private final RayGrid grid;
    private final Clearance clearance = new Clearance();
    private final List<Odometer> odometers = new ArrayList<>();
    private final AtomicReferenceArray<Command> commands;
    private final AtomicReferenceArray<@Nullable Pose> newOdometry;
    private volatile Snapshot latest;
    private @Nullable Thread advancing;

    private World(WorldSpec spec, WorldSettings settings, List<Pose> starts) {
        this.spec = spec;
        this.settings = settings;
        int robots = spec.robots().size();
        commands = new AtomicReferenceArray<>(robots);
        newOdometry = new AtomicReferenceArray<>(robots);
        physics = new Physics(robots, settings.physicsStepMicros(), needsContinuousPhysics(spec, settings));
        for (ObstacleSpec obstacle : spec.obstacles()) {
            physics.addObstacle(
                    obstacle.pose(),
                    obstacle.blocksBodies() ? obstacle.shape() : new io.troupe.sim.scenario.Shape(List.of()));
            if (obstacle.blocksBodies()) {
                clearance.add(obstacle.shape(), obstacle.pose());
            }
        }
        for (int robot = 0; robot < robots; robot++) {
            RobotSpec robotSpec = spec.robots().get(robot);
            physics.addRobot(starts.get(robot), robotSpec.shape(), robotSpec.massKg());
            odometers.add(new Odometer(starts.get(robot), robotSpec.startOdometry()));
            commands.set(robot, Command.STOP);
        }
        grid = new RayGrid(
                spec.obstacles().stream()
                        .map(each -> new RayGrid.Thing(
                                each.shape(), each.colour(), flags(each.blocksRangers(), each.visible())))
                        .toList(),
                spec.obstacles().stream().map(ObstacleSpec::pose).toList(),
                spec.robots().stream()
                        .map(each -> new RayGrid.Thing(
                                each.shape(), each.colour(), flags(each.blocksRangers(), each.visible())))
                        .toList());
        latest = sense(0, 0, List.of());
    }

    /**
     * A world at its start, sensors read.
     *
     * @throws IllegalArgumentException if the interval is not a whole number of physics steps, or a robot at full speed moves too far in one
     */
    public static World create(WorldSpec spec, WorldSettings settings) {
        long interval = spec.intervalMillis() * 1000L;
        if (interval % settings.physicsStepMicros() != 0) {
            throw new IllegalArgumentException(
                    "interval_sim is " + spec.intervalMillis() + " ms, expected a multiple of the physics step of "
                            + settings.physicsStepMicros() + " microseconds");
        }
        double stepS = settings.physicsStepMicros() / 1e6;
        if (settings.maxForwardMps() * stepS > Physics.MAX_TRAVEL_M
                || settings.maxTurnRadps() * stepS > Physics.MAX_TURN_RAD) {
            throw new IllegalArgumentException("a robot at " + settings.maxForwardMps() + " m/s and "
                    + settings.maxTurnRadps() + " rad/s moves too far in a physics step of "
                    + settings.physicsStepMicros() + " microseconds");
        }
        return new World(spec, settings, StartPoses.draw(spec, settings));
    }

    private static boolean needsContinuousPhysics(WorldSpec spec, WorldSettings settings) {
        double halfWidth = spec.robots().stream()
                .mapToDouble(each -> StrictMath.min(each.lengthM(), each.widthM()) / 2)
                .min()
                .orElse(1);
        return settings.maxForwardMps() * settings.physicsStepMicros() / 1e6 >= halfWidth;
    }

    private static int flags(boolean forRangers, boolean forCameras) {
        return (forRangers ? RayGrid.FOR_RANGERS : 0) | (forCameras ? RayGrid.FOR_CAMERAS : 0);
    }

    public WorldSpec spec() {
        return spec;
    }

    /** The newest snapshot; that of tick 0 right after creation. Any thread. */
    public Snapshot latest() {
        return latest;
    }

    /** Simulated time of the newest snapshot. Any thread. */
    public long timeMicros() {
        return latest.timeMicros();
    }

    /**
     * Sets a robot's speed from the next {@link #advance()} on, within the limits of the settings; the newest command wins. Any thread.
     *
     * @throws IllegalArgumentException if a speed is not a finite number
     */
    public void command(int robot, double forwardMps, double turnRadps) {
        if (!Double.isFinite(forwardMps) || !Double.isFinite(turnRadps)) {
            throw new IllegalArgumentException(spec.robots().get(robot).name() + " was told to drive at " + forwardMps
                    + " m/s and " + turnRadps + " rad/s, expected finite numbers");
        }
        commands.set(
                robot,
                new Command(
                        Math.clamp(forwardMps, -settings.maxForwardMps(), settings.maxForwardMps()),
                        Math.clamp(turnRadps, -settings.maxTurnRadps(), settings.maxTurnRadps())));
    }

    /** The same as {@code command(robot, 0, 0)}. */
    public void stop(int robot) {
        commands.set(robot, Command.STOP);
    }

    /** Makes odometry report this pose where the robot stands when the next {@link #advance()} begins. Any thread. */
    public void setOdometry(int robot, Pose pose) {
        newOdometry.set(robot, pose);
    }

    /** Advances by one interval: physics, then sensing. Always the same thread. */
    public Snapshot advance() {
        checkThread();
        long steps = spec.intervalMillis() * 1000L / settings.physicsStepMicros();
        for (int robot = 0; robot < commands.length(); robot++) {
            Pose odometry = newOdometry.getAndSet(robot, null);
            if (odometry != null) {
                odometers.get(robot).set(physics.pose(robot), odometry);
            }
            Command command = commands.get(robot);
            physics.drive(robot, command.forwardMps, command.turnRadps);
        }
        for (long step = 0; step < steps; step++) {
            physics.step();
        }
        Snapshot before = latest;
        var contacts = physics.drainTouches().stream()
                .map(touch -> new Contact(
                        touch.timeMicros(),
                        touch.robot(),
                        nameOfOther(touch.otherRobot(), touch.obstacle()),
                        touch.otherRobot()))
                .toList();
        latest = sense(before.tick() + 1, before.timeMicros() + spec.intervalMillis() * 1000L, contacts);
        return latest;
    }

    private String nameOfOther(int robot, int obstacle) {
        return robot >= 0
                ? spec.robots().get(robot).name()
                : spec.obstacles().get(obstacle).name();
    }

    private Snapshot sense(long tick, long timeMicros, List<Contact> contacts) {
        List<Pose> poses =
                IntStream.range(0, spec.robots().size()).mapToObj(physics::pose).toList();
        grid.placeRobots(poses);
        var readings = new ArrayList<RobotReading>(poses.size());
        for (int robot = 0; robot < poses.size(); robot++) {
            RobotSpec robotSpec = spec.robots().get(robot);
            Pose pose = poses.get(robot);
            Command command = commands.get(robot);
            readings.add(new RobotReading(
                    pose,
                    new Odometry(
                            odometers.get(robot).read(pose),
                            command.forwardMps,
                            command.turnRadps,
                            physics.stalled(robot)),
                    robotSpec.sonar() == null ? null : Sonar.read(robotSpec.sonar(), pose, robot, grid),
                    robotSpec.blobfinder() == null ? null : Blobfinder.read(robotSpec.blobfinder(), pose, robot, grid),
                    clearance.of(robotSpec.shape(), pose)));
        }
        return new Snapshot(tick, timeMicros, readings, contacts);
    }

    private void checkThread() {
        Thread caller = Thread.currentThread();
        if (advancing == null) {
            advancing = caller;
        } else if (advancing != caller) {
            throw new IllegalStateException("the world " + spec.name() + " is advanced by " + advancing.getName()
                    + ", and was called on " + caller.getName());
        }
    }
}
