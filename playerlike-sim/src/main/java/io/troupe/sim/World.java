package io.troupe.sim;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.device.Blobfinder;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Position2d;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.physics.Touch;
import io.troupe.sim.scenario.DriveSpec;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.Shape;
import io.troupe.sim.scenario.WorldFileException;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;
import java.util.concurrent.atomic.AtomicReferenceArray;
import org.jspecify.annotations.Nullable;

/**
 * A world of robots that advances by fixed intervals of simulated time.
 *
 * <p><b>Role.</b> The simulator itself: no server, no wall clock, no waiting. What it does follows from the specification, the
 * settings and, for each interval, the commands given before it; equal input gives equal snapshots, bit for bit.
 * <p><b>Threads.</b> {@link #advance} belongs to the thread that calls it first; everything else may be called from any thread.
 * <p><b>Order.</b> An interval latches odometry resets and commands (of several for one robot the newest; by robot index), runs
 * the physics steps, reads all devices and publishes a snapshot.
 * <p><b>Units and shapes.</b> SI; robots by index from 0, in the order of the world file.
 */
public final class World {
    private static final System.Logger LOG = System.getLogger(World.class.getName());
    private static final Shape NO_SHAPE = new Shape(List.of());

    private record Command(double forwardMps, double turnRadps) {
        static final Command ZERO = new Command(0, 0);
    }

    /** A robot's devices. */
    private record Devices(
            Position2d position2d,
            @Nullable Sonar sonar,
            @Nullable Blobfinder blobfinder) {}

    private final WorldSpec spec;
    private final WorldSettings settings;
    private final long intervalMicros;
    private final int stepsPerInterval;
    private final Physics physics;
    private final Scene scene;
    private final List<Devices> devices = new ArrayList<>();
    private final AtomicReferenceArray<Command> newestCommands;
    private final AtomicReferenceArray<@Nullable Pose> odometryToSet;
    private final Command[] latched;
    private final AtomicReference<@Nullable Thread> advancer = new AtomicReference<>();
    private volatile Snapshot latest;

    /**
     * A world at tick 0, its devices read once.
     *
     * <p><b>Errors.</b> {@link WorldFileException} for an interval or a body that cannot be simulated, or bodies that overlap,
     * {@link IllegalArgumentException} for settings that fit no world.
     */
    public static World create(WorldSpec spec, WorldSettings settings) {
        requireNonNull(spec, "spec");
        requireNonNull(settings, "settings");
        SpecCheck.check(spec, settings);
        if (!Physics.hasStandardSineTable()) {
            LOG.log(
                    System.Logger.Level.WARNING,
                    "this machine computes sines of its own: trajectories may differ from those of other machines");
        }
        return new World(spec, settings, StartPoses.of(spec, settings));
    }

    private World(WorldSpec spec, WorldSettings settings, List<Pose> startPoses) {
        this.spec = spec;
        this.settings = settings;
        intervalMicros = spec.intervalMillis() * 1000L;
        stepsPerInterval = Math.toIntExact(intervalMicros / settings.physicsStepMicros());
        int robotCount = spec.robots().size();
        newestCommands = new AtomicReferenceArray<>(robotCount);
        odometryToSet = new AtomicReferenceArray<>(robotCount);
        latched = new Command[robotCount];
        scene = new Scene(spec);
        physics = new Physics(robotCount, settings.physicsStepMicros(), sweepM());
        for (ObstacleSpec obstacle : spec.obstacles()) {
            physics.addObstacle(obstacle.pose(), obstacle.blocksBodies() ? obstacle.shape() : NO_SHAPE);
        }
        for (int i = 0; i < robotCount; i++) {
            RobotSpec robot = spec.robots().get(i);
            Pose start = startPoses.get(i);
            physics.addRobot(start, robot.collisionShape(), robot.massKg(), robot.blocksBodies());
            devices.add(devicesOf(robot, start));
            command(i, robot.drive().startForwardMps(), robot.drive().startTurnRadps());
            latched[i] = Command.ZERO;
        }
        latest = sense(0);
    }

    private static Devices devicesOf(RobotSpec robot, Pose start) {
        try {
            return new Devices(
                    new Position2d(start, robot.startOdometry()),
                    robot.sonar() == null ? null : new Sonar(robot.sonar()),
                    robot.blobfinder() == null ? null : new Blobfinder(robot.blobfinder()));
        } catch (IllegalArgumentException e) {
            throw new WorldFileException(robot.where(), "robot '" + robot.name() + "': " + e.getMessage());
        }
    }

    /** How far a point of a robot may travel in one step; 0 if that is less than half of every robot's smallest extent. */
    private double sweepM() {
        double stepS = settings.physicsStepMicros() / 1e6;
        double sweepM = 0;
        boolean fast = false;
        for (RobotSpec robot : spec.robots()) {
            List<Point> points = robot.collisionShape().polygons().stream()
                    .flatMap(List::stream)
                    .toList();
            var x = points.stream().mapToDouble(Point::x).summaryStatistics();
            var y = points.stream().mapToDouble(Point::y).summaryStatistics();
            double smallestM = Math.min(x.getMax() - x.getMin(), y.getMax() - y.getMin());
            double radiusM = points.stream()
                    .mapToDouble(point -> StrictMath.hypot(point.x(), point.y()))
                    .max()
                    .orElseThrow();
            double travelM = (settings.maxForwardMps() + settings.maxTurnRadps() * radiusM) * stepS;
            sweepM = Math.max(sweepM, travelM);
            fast |= travelM >= smallestM / 2;
        }
        return fast ? sweepM : 0;
    }

    public WorldSpec spec() {
        return spec;
    }

    /** The newest snapshot; that of tick 0 right after creation. */
    public Snapshot latest() {
        return latest;
    }

    /** Simulated time of the newest snapshot. */
    public long timeMicros() {
        return latest.timeMicros();
    }

    /**
     * Sets a robot's speed from the next {@link #advance} on, until another command replaces it.
     *
     * @param forwardMps clamped to the robot's bounds and the settings' limits, as is the turn rate
     * @param turnRadps left positive
     */
    public void command(int robot, double forwardMps, double turnRadps) {
        RobotSpec target = robot(robot);
        if (!Double.isFinite(forwardMps) || !Double.isFinite(turnRadps)) {
            throw new IllegalArgumentException("robot '" + target.name() + "' was told to drive at " + forwardMps
                    + " m/s and " + turnRadps + " rad/s, expected finite numbers");
        }
        DriveSpec.Bounds bounds = target.drive().velocityBounds();
        newestCommands.set(
                robot,
                new Command(
                        clamped(forwardMps, bounds.leastForward(), bounds.mostForward(), settings.maxForwardMps()),
                        clamped(turnRadps, bounds.leastTurn(), bounds.mostTurn(), settings.maxTurnRadps())));
    }

    private static double clamped(double wanted, double least, double most, double limit) {
        return Math.clamp(Math.clamp(wanted, least, most), -limit, limit);
    }

    /** The same as a command to stand still. */
    public void stop(int robot) {
        command(robot, 0, 0);
    }

    /** Makes odometry report this pose where the robot stands when the next {@link #advance} begins. */
    public void setOdometry(int robot, Pose pose) {
        RobotSpec target = robot(robot);
        if (!Double.isFinite(pose.x()) || !Double.isFinite(pose.y()) || !Double.isFinite(pose.headingRad())) {
            throw new IllegalArgumentException(
                    "odometry of robot '" + target.name() + "' was set to " + pose + ", expected finite numbers");
        }
        odometryToSet.set(robot, pose);
    }

    private RobotSpec robot(int robot) {
        List<RobotSpec> robots = spec.robots();
        if (robot < 0 || robot >= robots.size()) {
            throw new IllegalArgumentException("there is no robot " + robot + ", world '" + spec.name() + "' has "
                    + robots.size() + ", counted from 0");
        }
        return robots.get(robot);
    }

    /** Advances by one interval and publishes the snapshot at its end. */
    public Snapshot advance() {
        checkThread();
        latch();
        for (int i = 0; i < stepsPerInterval; i++) {
            physics.step();
        }
        Snapshot next = sense(latest.tick() + 1);
        latest = next;
        return next;
    }

    private void checkThread() {
        Thread current = Thread.currentThread();
        Thread owner = advancer.get();
        if (owner != current && !advancer.compareAndSet(null, current)) {
            throw new IllegalStateException(
                    "advance() belongs to thread '" + advancer.get().getName()
                            + "', which called it first, and was called by thread '" + current.getName() + "'");
        }
    }

    private void latch() {
        for (int i = 0; i < latched.length; i++) {
            Pose odometry = odometryToSet.getAndSet(i, null);
            if (odometry != null) {
                devices.get(i).position2d().set(physics.pose(i), odometry);
            }
            latched[i] = newestCommands.get(i);
            physics.drive(i, latched[i].forwardMps(), latched[i].turnRadps());
        }
    }

    private Snapshot sense(long tick) {
        for (int i = 0; i < latched.length; i++) {
            scene.place(i, physics.pose(i));
        }
        scene.refresh();
        List<RobotReading> readings = new ArrayList<>(latched.length);
        for (int i = 0; i < latched.length; i++) {
            readings.add(read(i));
        }
        List<Contact> contacts =
                physics.drainTouches().stream().map(this::contact).toList();
        return new Snapshot(tick, tick * intervalMicros, readings, contacts);
    }

    private RobotReading read(int robot) {
        Pose pose = physics.pose(robot);
        Devices its = devices.get(robot);
        Command command = latched[robot];
        var odometry = new Odometry(
                its.position2d().report(pose), command.forwardMps(), command.turnRadps(), physics.stalled(robot));
        return new RobotReading(
                pose,
                odometry,
                its.sonar() == null ? null : its.sonar().read(scene, robot),
                its.blobfinder() == null ? null : its.blobfinder().read(scene, robot),
                List.of(),
                scene.wallGapM(robot));
    }

    private Contact contact(Touch touch) {
        String other = touch.otherRobot() >= 0
                ? spec.robots().get(touch.otherRobot()).name()
                : spec.obstacles().get(touch.obstacle()).name();
        return new Contact(touch.timeMicros(), touch.robot(), other, touch.otherRobot());
    }
}
