package io.troupe.sim;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Scratch;
import io.troupe.sim.physics.Physics;
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
 * <p><b>Threads.</b> {@link #advance} and the {@link #view} belong to the thread that advances first; everything else may be called from any thread.
 * <p><b>Order.</b> An interval latches odometry resets and commands (of several for one robot the newest; by robot index), runs
 * the physics steps and reads all devices; the last one of an advance publishes a snapshot, and each one for which somebody waits
 * who asked for the {@link #latest} since the one before.
 * <p><b>Cost.</b> Intervals that publish nothing allocate nothing once the world is warm, as long as no more bodies touch and no more blobs are seen than ever before.
 * <p><b>Units and shapes.</b> SI; robots by index from 0, in the order of the world file.
 */
public final class World {
    private static final System.Logger LOG = System.getLogger(World.class.getName());
    private static final Shape NO_SHAPE = new Shape(List.of());

    private record Command(double forwardMps, double turnRadps) {}

    private final WorldSpec spec;
    private final WorldSettings settings;
    private final long intervalMicros;
    private final int stepsPerInterval;
    private final Physics physics;
    private final Scene scene;
    private final List<RobotDevices> devices;
    private final AtomicReferenceArray<@Nullable Command> newestCommands; // null: nothing new
    private final AtomicReferenceArray<@Nullable Pose> odometryToSet;
    private final double[] toldForwardMps; // for the next interval, unless there is a newer command
    private final double[] toldTurnRadps;
    private final double[] forwardMps; // in force in the interval that has ended
    private final double[] turnRadps;
    private final WorldView view = new WorldView(this);
    private final Scratch scratch = new Scratch();
    private final AtomicReference<@Nullable Thread> advancer = new AtomicReference<>();
    private long tick;
    private volatile boolean wanted; // somebody looked at the latest snapshot
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
        toldForwardMps = new double[robotCount];
        toldTurnRadps = new double[robotCount];
        forwardMps = new double[robotCount];
        turnRadps = new double[robotCount];
        scene = new Scene(spec);
        physics = new Physics(robotCount, settings.physicsStepMicros(), sweepM());
        for (ObstacleSpec obstacle : spec.obstacles()) {
            physics.addObstacle(obstacle.pose(), obstacle.blocksBodies() ? obstacle.shape() : NO_SHAPE);
        }
        for (int i = 0; i < robotCount; i++) {
            RobotSpec robot = spec.robots().get(i);
            Pose start = startPoses.get(i);
            physics.addRobot(start, robot.shape(), robot.massKg());
        }
        devices = RobotDevices.of(spec.robots(), startPoses);
        sense();
        latest = snapshot();
    }

    /** How far a point of a robot may travel in one step; 0 if that is less than half of every robot's smallest extent. */
    private double sweepM() {
        double stepS = settings.physicsStepMicros() / 1e6;
        double sweepM = 0;
        boolean fast = false;
        for (RobotSpec robot : spec.robots()) {
            List<Point> points =
                    robot.shape().polygons().stream().flatMap(List::stream).toList();
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

    /** The newest snapshot; that of tick 0 right after creation. Whoever asks while the world advances by many intervals gets it made sooner. */
    public Snapshot latest() {
        if (!wanted) {
            wanted = true;
        }
        return latest;
    }

    /** The world as it is now, for the thread that advances it. */
    public WorldView view() {
        return view;
    }

    /** Simulated time of the newest snapshot. */
    public long timeMicros() {
        return latest.timeMicros();
    }

    /**
     * Sets a robot's speed from the next {@link #advance} on, until another command replaces it.
     *
     * @param forwardMps clamped to the settings' limits, as is the turn rate
     * @param turnRadps left positive
     */
    public void command(int robot, double forwardMps, double turnRadps) {
        checkCommand(robot, forwardMps, turnRadps);
        newestCommands.set(robot, new Command(clampForward(forwardMps), clampTurn(turnRadps)));
    }

    /** The same for the thread that advances the world. */
    void commandNow(int robot, double forwardMps, double turnRadps) {
        checkCommand(robot, forwardMps, turnRadps);
        if (newestCommands.get(robot) != null) {
            newestCommands.set(robot, null);
        }
        toldForwardMps[robot] = clampForward(forwardMps);
        toldTurnRadps[robot] = clampTurn(turnRadps);
    }

    private void checkCommand(int robot, double forwardMps, double turnRadps) {
        RobotSpec target = robot(robot);
        if (!Double.isFinite(forwardMps) || !Double.isFinite(turnRadps)) {
            throw new IllegalArgumentException("robot '" + target.name() + "' was told to drive at " + forwardMps
                    + " m/s and " + turnRadps + " rad/s, expected finite numbers");
        }
    }

    private double clampForward(double mps) {
        return Math.clamp(mps, -settings.maxForwardMps(), settings.maxForwardMps());
    }

    private double clampTurn(double radps) {
        return Math.clamp(radps, -settings.maxTurnRadps(), settings.maxTurnRadps());
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
        return advance(1);
    }

    /** Advances by so many intervals and publishes the snapshot at the end of the last one. */
    public Snapshot advance(long intervals) {
        return advance(intervals, view -> {});
    }

    /**
     * Advances by so many intervals, asks the controller before each one, and publishes the snapshot at the end of the last one.
     *
     * @param intervals at least 1
     */
    public Snapshot advance(long intervals, Controller controller) {
        if (intervals < 1) {
            throw new IllegalArgumentException("cannot advance by " + intervals + " intervals, expected at least 1");
        }
        checkThread();
        try {
            for (long i = 0; i < intervals; i++) {
                if (wanted) {
                    publish();
                }
                controller.control(view);
                advanceUnpublished();
            }
        } finally {
            publish();
        }
        return latest;
    }

    private void publish() {
        wanted = false;
        if (latest.tick() != tick) {
            latest = snapshot();
        }
    }

    private void advanceUnpublished() {
        latch();
        physics.forgetTouches();
        for (int i = 0; i < stepsPerInterval; i++) {
            physics.step();
        }
        tick++;
        sense();
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
        for (int i = 0; i < forwardMps.length; i++) {
            if (odometryToSet.get(i) != null) {
                devices.get(i).position2d().set(physics.pose(i), requireNonNull(odometryToSet.getAndSet(i, null)));
            }
            if (newestCommands.get(i) != null) {
                Command newest = requireNonNull(newestCommands.getAndSet(i, null));
                toldForwardMps[i] = newest.forwardMps();
                toldTurnRadps[i] = newest.turnRadps();
            }
            forwardMps[i] = toldForwardMps[i];
            turnRadps[i] = toldTurnRadps[i];
            physics.drive(i, forwardMps[i], turnRadps[i]);
        }
    }

    /** Reads all devices. */
    private void sense() {
        for (int i = 0; i < forwardMps.length; i++) {
            scene.place(i, physics.x(i), physics.y(i), physics.headingRad(i));
        }
        scene.refresh();
        for (int i = 0; i < forwardMps.length; i++) {
            devices.get(i).sense(scene, i, scratch);
        }
    }

    Snapshot snapshot() {
        List<RobotReading> readings = new ArrayList<>(forwardMps.length);
        for (int i = 0; i < forwardMps.length; i++) {
            readings.add(read(i));
        }
        return new Snapshot(tick, tick * intervalMicros, readings, Contacts.of(physics.touches(), spec));
    }

    private RobotReading read(int robot) {
        Pose pose = physics.pose(robot);
        RobotDevices its = devices.get(robot);
        var odometry = new Odometry(
                its.position2d().report(pose), forwardMps[robot], turnRadps[robot], physics.stalled(robot));
        return new RobotReading(
                pose,
                odometry,
                its.sonar() == null ? null : its.sonar().rangesM(),
                its.blobfinder() == null ? null : its.blobfinder().image(),
                List.of(),
                scene.wallGapM(robot));
    }

    // ---- for the view

    long tick() {
        return tick;
    }

    long intervalMicros() {
        return intervalMicros;
    }

    double forwardMps(int robot) {
        return forwardMps[robot];
    }

    double turnRadps(int robot) {
        return turnRadps[robot];
    }

    RobotDevices devices(int robot) {
        return devices.get(robot);
    }

    Physics physics() {
        return physics;
    }

    Scene scene() {
        return scene;
    }
}
