package io.troupe.sim;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Position2d;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Scratch;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.physics.Touches;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * A world of robots that advances by fixed intervals of simulated time.
 *
 * <p><b>Role.</b> The simulator without server, wall clock or waiting. Its behaviour follows from the specification,
 * the settings and the commands given before each interval; equal input gives equal snapshots, bit for bit.
 *
 * <p><b>Threads.</b> {@link #advance} and the {@link #view} belong to the thread that advances first; everything else
 * may be called from any thread.
 *
 * <p><b>Order.</b> At the start of an interval the world takes a reset, boxes, robots and obstacles that leave,
 * obstacles that are placed, teleports, odometry resets, motor power and commands, by index (of several commands for
 * one robot the newest). Then it runs the physics steps and reads all devices. The last interval of an advance
 * publishes a snapshot. An earlier interval publishes one if the world is recorded, or if {@link #latest} has been
 * called since the previous one.
 *
 * <p><b>Cost.</b> Intervals that publish nothing allocate nothing once the world is warm, as long as there are no more
 * touching bodies and no more visible blobs than ever before.
 *
 * <p><b>Units and shapes.</b> SI; robots by index from 0, in the order of the world file.
 *
 * <p>Long, because everything that can be done to a world is a method here, with its contract.
 */
public final class World implements AutoCloseable {
    private final WorldSpec spec;
    private final WorldSettings settings;
    private final long intervalMicros;
    private final int stepsPerInterval;
    private final StartPoses starts;
    private final WorldCommands commands;
    private final List<String> robotNames;
    private final Boxes boxes;
    private final WorldView view = new WorldView(this);
    private final Scratch[] scratches;
    private final SensingThreads sensing;
    private final AtomicReference<@Nullable Thread> advancer = new AtomicReference<>();
    private WorldSpec furnished; // with the boxes
    private Scene scene;
    private List<SimulatedDevices> devices;
    private Physics physics;
    private Grippers grippers;
    private long physicsStartMicros; // the physics counts its time from the last reset
    private long tick;
    private boolean advancing;
    private volatile boolean closed;
    private volatile boolean snapshotRequested; // latest() was called since the last publication
    private volatile Snapshot latest;

    /**
     * Creates a world at tick 0, its devices read once. A robot that overlaps something is held there, and stalls,
     * until it is teleported.
     *
     * <p><b>Errors.</b> {@link WorldFileException} for an interval or a body that cannot be simulated,
     * {@link IllegalArgumentException} for settings that fit no world.
     */
    public static World create(WorldSpec spec, WorldSettings settings) {
        return create(spec, settings, new SensingThreads.MeasuredChoice());
    }

    /** As {@link #create(WorldSpec, WorldSettings)}, with sensing threads that are used by a given choice. */
    static World create(WorldSpec spec, WorldSettings settings, SensingThreads.Choice choice) {
        requireNonNull(spec, "spec");
        requireNonNull(settings, "settings");
        SpecCheck.check(spec, settings);
        if (!Physics.hasStandardSineTable()) {
            System.getLogger(World.class.getName())
                    .log(
                            System.Logger.Level.WARNING,
                            "this machine computes sines in another way: trajectories may differ from those of other machines");
        }
        return new World(spec, settings, StartPoses.of(spec, settings), choice);
    }

    private World(WorldSpec spec, WorldSettings settings, StartPoses starts, SensingThreads.Choice choice) {
        this.spec = spec;
        this.settings = settings;
        this.starts = starts;
        intervalMicros = spec.intervalMillis() * 1000L;
        stepsPerInterval = Math.toIntExact(intervalMicros / PhysicsSetup.stepMicros(spec, settings));
        int robotCount = spec.robots().size();
        furnished = spec;
        boxes = new Boxes();
        scene = new Scene(spec);
        commands = new WorldCommands(spec, settings);
        robotNames = spec.robots().stream().map(RobotSpec::name).toList();
        physics = PhysicsSetup.atStart(spec, settings, starts);
        devices = SimulatedDevices.of(spec.robots(), starts.poses(), settings.seed());
        grippers = new Grippers(spec, commands.contents(), scene, physics, devices);
        int threads = Math.clamp(robotCount, 1, settings.sensingThreads());
        if (spec.robots().stream().anyMatch(robot -> robot.rangers().stream().anyMatch(RangerSpec::intensities))) {
            scene.readReflectances();
        }
        scratches = Stream.generate(Scratch::new).limit(threads).toArray(Scratch[]::new);
        sensing = new SensingThreads(spec.name(), threads, robotCount, choice, this::senseRange);
        sense();
        latest = snapshot();
    }

    public WorldSpec spec() {
        return spec;
    }

    /**
     * The newest snapshot; that of tick 0 right after creation. During a long advance, reading this publishes an
     * intermediate snapshot.
     */
    public Snapshot latest() {
        if (!snapshotRequested) {
            snapshotRequested = true;
        }
        return latest;
    }

    /** The current state of the world, for the thread that advances it. */
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
     * @param forwardMps clamped to the robot's bounds and the settings' limits, as is the turn rate
     * @param turnRadps left positive; for a robot that steers like a car, the angle of its front wheels
     */
    public void command(int robot, double forwardMps, double turnRadps) {
        commands.drive(robot, forwardMps, 0, turnRadps, 0);
    }

    /**
     * As {@link #command(int, double, double)}, for a robot that can move sideways.
     *
     * @param sidewaysMps left positive; without effect unless the drive is omnidirectional
     */
    public void command(int robot, double forwardMps, double sidewaysMps, double turnRadps) {
        commands.drive(robot, forwardMps, sidewaysMps, turnRadps, 0);
    }

    /**
     * As {@link #command(int, double, double, double)}, for a client whose commands expire.
     *
     * @param limitMicros how long the speed holds, in simulated time from the beginning of the interval in which it
     *     takes effect, but for one interval at least; 0 = until another command
     */
    void commandFor(long limitMicros, int robot, double forwardMps, double sidewaysMps, double turnRadps) {
        commands.drive(robot, forwardMps, sidewaysMps, turnRadps, limitMicros);
    }

    /** As {@link #command(int, double, double)}, for the thread that advances the world. */
    void commandNow(int robot, double forwardMps, double turnRadps) {
        commands.driveNow(robot, forwardMps, turnRadps);
    }

    /**
     * Drives at a speed and steers to a heading in the odometry frame, until another command replaces it.
     *
     * @param forwardMps clamped to the settings' limits
     */
    public void steer(int robot, double forwardMps, double headingRad) {
        steer(robot, forwardMps, headingRad, 0);
    }

    /** As {@link #steer(int, double, double)}, for a client whose commands expire. */
    void steer(int robot, double forwardMps, double headingRad, long limitMicros) {
        commands.steer(robot, forwardMps, headingRad, limitMicros);
    }

    /**
     * Drives to a pose in the odometry frame by Stage's position control, and stands there, until another command
     * replaces it. The robot stops nearer than 2 cm along x and y and then turns. It does not avoid obstacles.
     */
    public void goTo(int robot, Pose goal) {
        commands.goTo(robot, goal);
    }

    /**
     * Switches a robot's motors, which are on at the start. While they are off, the robot stands still and commands are
     * discarded.
     */
    public void motorPower(int robot, boolean on) {
        commands.power(robot, on);
    }

    /**
     * Switches the measuring of intensities by a laser or ranger, from the next interval on. It is off at the start,
     * unless the file has something bright ({@code laser_return 2}).
     */
    public void measureIntensities(int robot, int ranger, boolean on) {
        commands.measureIntensities(robot, ranger, on);
    }

    /**
     * Opens or closes a gripper, from the next interval on.
     *
     * @param device its index in {@link RobotSpec#devices}
     */
    public void grip(int robot, int device, GripperDevice.Order order) {
        commands.grip(robot, device, order);
    }

    /**
     * Moves a robot to a pose when the next {@link #advance} begins. A robot that was taken out is back then.
     *
     * <p><b>Errors.</b> {@link IllegalArgumentException} if it would overlap something in the newest snapshot. If
     * another body is in the way when the teleport takes effect, the robot stays where it is, and a warning is logged.
     */
    public void teleport(int robot, Pose pose) {
        String refusal = teleportRefusal(robot, pose);
        if (refusal != null) {
            throw new IllegalArgumentException(refusal);
        }
        teleportLater(robot, pose);
    }

    /**
     * Takes a robot out of the world when the next {@link #advance} begins. Nothing touches or senses it, its commands
     * are discarded, and its pose and readings stay as they are, until it is teleported. What its gripper holds is put
     * down.
     */
    public void removeRobot(int robot) {
        commands.removeRobot(robot);
    }

    /** Takes an obstacle out of the world when the next {@link #advance} begins; a gripper that holds it loses it. */
    public void removeObstacle(int obstacle) {
        commands.removeObstacle(obstacle);
    }

    /**
     * Puts an obstacle at a pose when the next {@link #advance} begins, whether it was elsewhere, out of the world or
     * in a gripper.
     *
     * <p><b>Errors.</b> {@link IllegalArgumentException} if it would overlap a robot or an obstacle that may move in
     * the newest snapshot or, if it may move itself, any obstacle. If something is in the way when the change takes
     * effect, the obstacle stays where it was, and a warning is logged.
     *
     * <p><b>Cost.</b> An interval that begins with such changes builds everything that devices sense anew.
     */
    public void placeObstacle(int obstacle, Pose pose) {
        String refusal = obstacleRefusal(obstacle, pose);
        if (refusal != null) {
            throw new IllegalArgumentException(refusal);
        }
        placeObstacleLater(obstacle, pose);
    }

    /** Reason why {@link #placeObstacle} would be refused, or null. */
    @Nullable
    String obstacleRefusal(int obstacle, Pose pose) {
        return commands.obstacleRefusal(obstacle, pose, latest);
    }

    /** As {@link #placeObstacle}, checked only when it takes effect. */
    void placeObstacleLater(int obstacle, Pose pose) {
        commands.placeObstacle(obstacle, pose);
    }

    /**
     * Puts a box into the world when the next {@link #advance} begins, or moves it. A robot that touches something then
     * begins to touch it once more.
     *
     * <p><b>Cost.</b> As much as creating the world.
     *
     * <p><b>Errors.</b> As with {@link #teleport}.
     */
    public void putBox(ColouredBox box) {
        String refusal = commands.boxRefusal(box, latest);
        if (refusal != null) {
            throw new IllegalArgumentException(refusal);
        }
        putBoxLater(box);
    }

    /** A box that is checked only when it takes effect. */
    void putBoxLater(ColouredBox box) {
        boxes.put(box);
    }

    /** Removes a box when the next {@link #advance} begins, if it is there. */
    public void removeBox(int number) {
        boxes.remove(number);
    }

    /** Reason why {@link #teleport} would be refused, or null. */
    @Nullable
    String teleportRefusal(int robot, Pose pose) {
        return commands.teleportRefusal(robot, pose, latest);
    }

    /** A teleport that is checked only when it takes effect. */
    void teleportLater(int robot, Pose pose) {
        commands.teleport(robot, pose);
    }

    /** Index of the robot with a name, or -1. */
    int robotNumber(String name) {
        return robotNames.indexOf(name);
    }

    /**
     * Resets the world when the next {@link #advance} begins: poses, odometry, motors, random streams, what is there.
     * Earlier commands are discarded; ticks and time continue. A controller is called after the reset, and sees the
     * start. With the same commands, the run then repeats bit for bit.
     */
    public void reset() {
        boxes.forgetPending();
        commands.reset();
    }

    /**
     * Starts a recording of all input; must be called before the first advance.
     *
     * @param out is closed with the recording if it is closeable
     * @throws IllegalStateException if the world has advanced already or is being recorded
     */
    public Recording record(Appendable out) {
        return commands.record(out, latest);
    }

    @Nullable
    Recording recording() {
        return commands.recording();
    }

    /** Stops a robot; the same as a command with zero speeds. */
    public void stop(int robot) {
        command(robot, 0, 0);
    }

    /**
     * Sets the pose that odometry reports at the robot's place when the next {@link #advance} begins.
     *
     * @param pose of finite numbers, at most {@link Position2d#FARTHEST}
     */
    public void setOdometry(int robot, Pose pose) {
        commands.odometry(robot, pose);
    }

    /** Reason why {@link #setOdometry} would be refused, or null. */
    @Nullable
    String odometryRefusal(int robot, Pose pose) {
        return commands.odometryRefusal(robot, pose);
    }

    /** Advances by one interval and publishes the snapshot at its end. */
    public Snapshot advance() {
        return advance(1);
    }

    /** Advances by the given number of intervals and publishes the snapshot at the end of the last one. */
    public Snapshot advance(long intervals) {
        return advance(intervals, view -> {});
    }

    /**
     * Advances by the given number of intervals, calls the controller before each one, and publishes the snapshot at
     * the end of the last one.
     *
     * @param intervals at least 1
     * @throws IllegalStateException if the world is closed, or called by its own controller
     */
    public Snapshot advance(long intervals, IntervalCallback controller) {
        if (intervals < 1) {
            throw new IllegalArgumentException("cannot advance by " + intervals + " intervals, expected at least 1");
        }
        checkThread();
        if (closed) {
            throw new IllegalStateException("world '" + spec.name() + "' is closed");
        }
        if (advancing) {
            throw new IllegalStateException("world '" + spec.name()
                    + "' is advancing already: a controller commands robots," + " and must not call advance()");
        }
        advancing = true;
        try {
            for (long i = 0; i < intervals; i++) {
                if (snapshotRequested) {
                    publish();
                }
                resetIfRequested();
                if (boxes.hasPending()) {
                    takeBoxes();
                }
                controller.control(view);
                advanceUnpublished();
                Recording log = commands.recording();
                if (log != null) {
                    publish();
                    log.advanced(latest);
                }
            }
        } finally {
            advancing = false;
            publish();
        }
        return latest;
    }

    /**
     * Ends the sensing threads. A current advance runs to its end; later ones are refused. A world with one thread
     * needs no closing.
     */
    @Override
    public void close() {
        closed = true;
        sensing.close();
    }

    private void publish() {
        snapshotRequested = false;
        if (latest.tick() != tick) {
            latest = snapshot();
        }
    }

    private void advanceUnpublished() {
        if (commands.apply(tick, tick * intervalMicros, physics, devices, scene, grippers)) {
            changeScene(commands.contents().sensed());
        }
        physics.forgetTouches();
        physics.advance(stepsPerInterval);
        tick++;
        sense();
        grippers.update(scratches[0]);
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

    private void resetIfRequested() {
        long nowMicros = tick * intervalMicros;
        if (commands.takeReset(nowMicros)) {
            boxes.clear();
            if (commands.returnToStart()) {
                furnished = spec;
                changeScene(spec);
            }
            physics = PhysicsSetup.atStart(spec, settings, starts);
            physicsStartMicros = nowMicros;
            devices = SimulatedDevices.of(spec.robots(), starts.poses(), settings.seed());
            grippers = new Grippers(spec, commands.contents(), scene, physics, devices);
            sense(); // as at the start: each reading advances the random streams
        }
    }

    private void takeBoxes() {
        if (boxes.apply(tick, box -> commands.boxRefusal(box, physics), commands.recording())) {
            furnish();
        }
    }

    /** Builds bodies and scene anew with the boxes, everything else where it is. */
    private void furnish() {
        WorldContents contents = commands.furnish(boxes.all());
        furnished = contents.furnished();
        Physics before = physics;
        List<Pose> poses = Stream.concat(
                        IntStream.range(0, devices.size()).mapToObj(before::pose), grippers.poses().stream())
                .toList();
        physics = PhysicsSetup.at(furnished, settings, poses, before::isHeld);
        IntStream.range(0, spec.obstacles().size())
                .filter(obstacle -> !contents.holds(obstacle))
                .forEach(physics::removeObstacle);
        IntStream.range(0, devices.size()).filter(contents::isAway).forEach(physics::removeRobot);
        physicsStartMicros = tick * intervalMicros;
        changeScene(contents.sensed());
        for (int i = 0; i < poses.size(); i++) { // robots, and after them the obstacles that move
            scene.place(i, poses.get(i));
        }
        scene.refresh();
    }

    /** Builds anew what devices sense. */
    private void changeScene(WorldSpec sensed) {
        boolean reflects = scene.hasReflectances();
        scene = new Scene(sensed);
        if (reflects) {
            scene.readReflectances();
        }
        grippers.continueIn(scene, physics);
    }

    /** Reads all devices. */
    private void sense() {
        for (int i = 0; i < devices.size(); i++) {
            double x = physics.x(i);
            double y = physics.y(i);
            double headingRad = physics.headingRad(i);
            scene.place(i, x, y, headingRad);
            if (!isAway(i)) {
                devices.get(i).position2d().sense(x, y, headingRad);
            }
        }
        grippers.place();
        scene.refresh();
        sensing.run();
    }

    private void senseRange(int range, int fromRobot, int toRobot) {
        for (int i = fromRobot; i < toRobot; i++) {
            if (!isAway(i)) {
                devices.get(i).sense(scene, i, scratches[range]);
            }
        }
    }

    Snapshot snapshot() {
        List<RobotReading> readings = new ArrayList<>(devices.size());
        for (int i = 0; i < devices.size(); i++) {
            readings.add(read(i));
        }
        WorldContents contents = commands.contents();
        return new Snapshot(
                tick,
                tick * intervalMicros,
                readings,
                contacts(),
                grippers.sensedPoses(),
                boxes.all(),
                contents.placedObstacles(),
                contents.awayRobots(),
                grippers.held());
    }

    /** The touches of the physics, with names instead of indices and with the world's time. */
    private List<Contact> contacts() {
        Touches touches = physics.touches();
        return IntStream.range(0, touches.count())
                .mapToObj(i -> {
                    int otherRobot = touches.otherRobot(i);
                    String other = otherRobot >= 0
                            ? spec.robots().get(otherRobot).name()
                            : furnished.obstacles().get(touches.obstacle(i)).name();
                    return new Contact(physicsStartMicros + touches.timeMicros(i), touches.robot(i), other, otherRobot);
                })
                .toList();
    }

    private RobotReading read(int robot) {
        Pose pose = physics.pose(robot);
        SimulatedDevices robotDevices = devices.get(robot);
        var odometry = new Odometry(
                robotDevices.position2d().reported(),
                commands.forwardMps(robot),
                commands.sidewaysMps(robot),
                commands.turnRadps(robot),
                physics.stalled(robot));
        return new RobotReading(
                pose,
                odometry,
                robotDevices.sonar() == null ? null : robotDevices.sonar().rangesM(),
                robotDevices.blobfinder() == null
                        ? null
                        : robotDevices.blobfinder().image(),
                robotDevices.rangersM().isEmpty()
                        ? List.of()
                        : robotDevices.rangersM().stream()
                                .map(ranges -> Arrays.stream(ranges).boxed().toList())
                                .toList(),
                intensities(robotDevices),
                robotDevices.others().isEmpty()
                        ? List.of()
                        : robotDevices.others().stream()
                                .map(device -> device.reading(scene, robot))
                                .toList(),
                scene.wallGapM(robot));
    }

    private static List<List<Double>> intensities(SimulatedDevices devices) {
        for (int i = 0; i < devices.rangers().size(); i++) {
            if (devices.rangers().get(i).measuresIntensities()) {
                return devices.rangers().stream().map(Ranger::intensities).toList();
            }
        }
        return List.of();
    }

    // ---- for the view

    boolean isAway(int robot) {
        return commands.contents().isAway(robot);
    }

    boolean holdsObstacle(int obstacle) {
        return commands.contents().holds(obstacle);
    }

    double sidewaysMps(int robot) {
        return commands.sidewaysMps(robot);
    }

    long tick() {
        return tick;
    }

    long intervalMicros() {
        return intervalMicros;
    }

    double forwardMps(int robot) {
        return commands.forwardMps(robot);
    }

    double turnRadps(int robot) {
        return commands.turnRadps(robot);
    }

    SimulatedDevices devices(int robot) {
        return devices.get(robot);
    }

    long physicsStartMicros() {
        return physicsStartMicros;
    }

    Physics physics() {
        return physics;
    }

    Scene scene() {
        return scene;
    }
}
