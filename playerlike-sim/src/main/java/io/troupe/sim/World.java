package io.troupe.sim;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.device.Blobfinder;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Position2d;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.physics.Touch;
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
import java.util.function.IntFunction;
import org.jspecify.annotations.Nullable;

/**
 * A world of robots that advances by fixed intervals of simulated time.
 *
 * <p><b>Role.</b> The simulator itself: no server, no wall clock, no waiting. What it does follows from the specification, the
 * settings and, for each interval, the commands given before it; equal input gives equal snapshots, bit for bit.
 * <p><b>Threads.</b> {@link #advance} belongs to the thread that calls it first; everything else may be called from any thread.
 * <p><b>Order.</b> An interval latches a reset, teleports, odometry resets, motor power and commands (of several for one robot the newest; by robot index), runs
 * the physics steps, reads all devices and publishes a snapshot.
 * <p><b>Units and shapes.</b> SI; robots by index from 0, in the order of the world file.
 */
public final class World {
    private static final System.Logger LOG = System.getLogger(World.class.getName());
    private static final Shape NO_SHAPE = new Shape(List.of());

    /** A robot's devices. */
    private record Devices(
            Position2d position2d,
            @Nullable Sonar sonar,
            @Nullable Blobfinder blobfinder,
            List<Ranger> rangers) {}

    private final WorldSpec spec;
    private final WorldSettings settings;
    private final long intervalMicros;
    private final int stepsPerInterval;
    private final List<Pose> startPoses;
    private final Orders orders;
    private final List<String> robotNames;
    private final Scene scene;
    private final List<Devices> devices = new ArrayList<>();
    private final IntFunction<Position2d> position2d =
            robot -> devices.get(robot).position2d();
    private final Drive.Velocity[] latched;
    private final AtomicReference<@Nullable Thread> advancer = new AtomicReference<>();
    private Physics physics;
    private long physicsStartMicros; // physics counts its time from the last reset
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
        this.startPoses = startPoses;
        intervalMicros = spec.intervalMillis() * 1000L;
        stepsPerInterval = Math.toIntExact(intervalMicros / settings.physicsStepMicros());
        int robotCount = spec.robots().size();
        latched = new Drive.Velocity[robotCount];
        scene = new Scene(spec);
        orders = new Orders(spec, settings);
        robotNames = spec.robots().stream().map(RobotSpec::name).toList();
        physics = begin();
        latest = sense(0);
    }

    /** Everything at its start. */
    private Physics begin() {
        var begun = new Physics(spec.robots().size(), settings.physicsStepMicros(), sweepM());
        for (ObstacleSpec obstacle : spec.obstacles()) {
            begun.addObstacle(obstacle.pose(), obstacle.blocksBodies() ? obstacle.shape() : NO_SHAPE);
        }
        devices.clear();
        for (int i = 0; i < spec.robots().size(); i++) {
            RobotSpec robot = spec.robots().get(i);
            Pose start = startPoses.get(i);
            begun.addRobot(start, robot.shape(), robot.massKg());
            devices.add(devicesOf(robot, start));
            latched[i] = Drive.STILL;
        }
        return begun;
    }

    private Devices devicesOf(RobotSpec robot, Pose start) {
        try {
            return new Devices(
                    new Position2d(start, robot.startOdometry(), Noise.ofOdometry(robot, settings.seed())),
                    robot.sonar() == null ? null : new Sonar(robot.sonar()),
                    robot.blobfinder() == null ? null : new Blobfinder(robot.blobfinder()),
                    Noise.rangers(robot, settings.seed()));
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
     * @param forwardMps clamped to the settings' limits, as is the turn rate
     * @param turnRadps left positive
     */
    public void command(int robot, double forwardMps, double turnRadps) {
        orders.drive(robot, forwardMps, turnRadps);
    }

    /**
     * Drives at a speed and steers to a heading in the odometry frame, until another command replaces it.
     *
     * @param forwardMps clamped to the settings' limits
     */
    public void steer(int robot, double forwardMps, double headingRad) {
        orders.steer(robot, forwardMps, headingRad);
    }

    /**
     * Drives to a pose in the odometry frame in the way of Stage's position control, and stands there, until another command replaces it. It stops nearer than
     * 2 cm along x and y and then turns; things in its way it does not see.
     */
    public void goTo(int robot, Pose goal) {
        orders.goTo(robot, goal);
    }

    /** Switches a robot's motors; while they are off it stands still and forgets what it is told. On at the start. */
    public void motorPower(int robot, boolean on) {
        orders.power(robot, on);
    }

    /**
     * Puts a robot elsewhere when the next {@link #advance} begins.
     *
     * <p><b>Errors.</b> {@link IllegalArgumentException} if it would overlap something where everything is at the newest snapshot. If something else has got
     * there by then, the robot stays where it is, and the log says so.
     */
    public void teleport(int robot, Pose pose) {
        String refusal = teleportRefusal(robot, pose);
        if (refusal != null) {
            throw new IllegalArgumentException(refusal);
        }
        teleportLater(robot, pose);
    }

    /** Why {@link #teleport} would refuse, or null. */
    @Nullable
    String teleportRefusal(int robot, Pose pose) {
        return orders.teleportRefusal(robot, pose, latest);
    }

    /** A teleport that is checked only when it takes effect. */
    void teleportLater(int robot, Pose pose) {
        orders.teleport(robot, pose);
    }

    /** Index of the robot of that name, or -1. */
    int robotNumber(String name) {
        return robotNames.indexOf(name);
    }

    /**
     * Puts everything back to its start when the next {@link #advance} begins: poses, odometry, motors, random streams; what robots were told before is
     * forgotten. Ticks and time go on. What follows is what followed at the beginning, bit for bit, if the commands are the same.
     */
    public void reset() {
        orders.reset();
    }

    /**
     * Begins to write down all that enters this world; to be called before anybody advances it.
     *
     * @param out is closed with the recording if it can be
     * @throws IllegalStateException if the world has advanced already or is being recorded
     */
    public Recording record(Appendable out) {
        return orders.record(out, latest);
    }

    @Nullable
    Recording recording() {
        return orders.recording();
    }

    /** The same as a command to stand still. */
    public void stop(int robot) {
        command(robot, 0, 0);
    }

    /** Makes odometry report this pose where the robot stands when the next {@link #advance} begins. */
    public void setOdometry(int robot, Pose pose) {
        orders.odometry(robot, pose);
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
        Recording log = orders.recording();
        if (log != null) {
            log.advanced(next);
        }
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
        if (orders.takeReset(latest.timeMicros())) {
            physics = begin();
            physicsStartMicros = latest.timeMicros();
            sense(latest.tick()); // as at the start: each reading moves the random streams on
        }
        orders.latch(latest, physics, position2d, latched);
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
        Drive.Velocity command = latched[robot];
        var odometry = new Odometry(
                its.position2d().report(pose), command.forwardMps(), command.turnRadps(), physics.stalled(robot));
        return new RobotReading(
                pose,
                odometry,
                its.sonar() == null ? null : its.sonar().read(scene, robot),
                its.blobfinder() == null ? null : its.blobfinder().read(scene, robot),
                its.rangers().stream().map(ranger -> ranger.read(scene, robot)).toList(),
                scene.wallGapM(robot));
    }

    private Contact contact(Touch touch) {
        String other = touch.otherRobot() >= 0
                ? spec.robots().get(touch.otherRobot()).name()
                : spec.obstacles().get(touch.obstacle()).name();
        return new Contact(physicsStartMicros + touch.timeMicros(), touch.robot(), other, touch.otherRobot());
    }
}
