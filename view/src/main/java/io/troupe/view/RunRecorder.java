package io.troupe.view;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.DriverReport;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Contact;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.RunResult.Messages;
import io.troupe.view.RunResult.StateChange;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import java.util.Objects;
import java.util.Optional;
import java.util.SortedMap;
import java.util.TreeSet;
import java.util.function.Consumer;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Records a run: writes {@code run.jsonl} and collects the {@link RunResult}.
 *
 * <p><b>Role.</b> For a run whose loop is the caller's; {@link RecordedRun} has the loop of the main job.
 *
 * {@snippet :
 * log.begin(scenario.world(), described);
 * var recorder = new RunRecorder(scenario.world(), table, log, change -> {});
 * var robots = RobotServicesActor.Settings.defaults().withObserver(recorder);
 * var settings = SubsumptionRun.Settings.defaults()
 *         .withMode(Mode.CALLBACK)
 *         .withRobots(robots)
 *         .withClock(simulation.clock())
 *         .withListener(recorder);
 * try (var running = SubsumptionRun.start(settings)) {
 *     recorder.start(simulation.latest());
 *     while (simulation.timeMicros() < 2_000_000) {
 *         Snapshot snapshot = simulation.tick();
 *         running.check();
 *         recorder.record(snapshot);
 *     }
 * }
 * RunResult result = recorder.finish(false);
 * }
 *
 * <p><b>Threads.</b> The services call it on the actor space's thread, the run loop on the thread that advances the
 * world. In lock step the two never call at the same time, and each tick publishes the writes of one thread to the
 * other.
 *
 * <p><b>Errors.</b> A line that cannot be written does not end the run; {@link RunLog#close} reports it.
 */
public final class RunRecorder implements ServiceObserver, Arbitrator.StateListener {
    /**
     * From this number of robots on, a run is reported as a crowd: the summary has sums and extremes, and the log has
     * poses once a second instead of at every tick.
     */
    public static final int MANY_ROBOTS = 11;

    private static final long CROWD_POSE_MICROS = 1_000_000;
    private static final double CROWD_PATH_STEP_M = 0.25;

    private final WorldSpec world;
    private final SubsumptionTable table;
    private final RunLog log;
    private final Consumer<String> changes;
    private final List<RobotRecord> robots;
    private final List<StateChange> states = new ArrayList<>();
    private long sent;
    private long received;
    private long tooLate;
    private int statesLogged;
    private SortedMap<Integer, Optional<Pose>> displaced = Collections.emptySortedMap(); // as logged
    private SortedMap<Integer, Integer> held = Collections.emptySortedMap(); // as logged
    private final List<List<DeviceReading.Grip>> grips; // as logged, by robot
    private @Nullable Snapshot last;

    /**
     * Creates the recorder of one run.
     *
     * @param changes is called with a line of text for every state change, on the thread that calls {@link #record}
     */
    public RunRecorder(WorldSpec world, SubsumptionTable table, RunLog log, Consumer<String> changes) {
        this.world = world;
        this.table = table;
        this.log = log;
        this.changes = changes;
        this.robots = IntStream.range(0, world.robots().size())
                .mapToObj(index -> new RobotRecord(index, world.robots().size() < MANY_ROBOTS ? 0 : CROWD_PATH_STEP_M))
                .toList();
        this.grips = new ArrayList<>(Collections.nCopies(world.robots().size(), List.of()));
    }

    /** The recorder of a run in which robots have no services: drives of Player programs, or of an application. */
    public RunRecorder(WorldSpec world, RunLog log) {
        this(world, SubsumptionTable.NONE, log, change -> {});
    }

    // ---- called by the services

    @Override
    public void serviceStarted(int robot, Service service) {
        robots.get(robot).began(service);
    }

    @Override
    public void cycleEnded(int robot, Service service) {
        robots.get(robot).cycled(service);
    }

    @Override
    public void serviceEnded(int robot, Service service) {
        robots.get(robot).ended(service);
    }

    @Override
    public void colourSent(int robot, int colour) {
        sent++;
    }

    @Override
    public void colourReceived(int robot, int colour) {
        received++;
    }

    @Override
    public void colourTooLate(int robot, int colour) {
        tooLate++;
    }

    @Override
    public void stateStarted(State state, @Nullable Integer seenBy) {
        states.add(new StateChange(timeMicros(), state, seenBy));
    }

    // ---- over hosts

    /** @param drivers is called with a line of text when a node begins to drive a robot */
    void driverReported(DriverReport report, String node, Consumer<String> drivers) {
        if (report.robotIndex() < 0 || report.robotIndex() >= robots.size()) {
            return; // of another table
        }
        RobotRecord robot = robots.get(report.robotIndex());
        boolean begins = report.event() == DriverReport.Event.STARTED;
        if (begins && !node.equals(robot.node())) {
            robot.lostDriver(); // the node before has not reported its end, or not yet
            robot.drivenBy(timeMicros(), node);
            log.write(Json.line(timeMicros(), "driver")
                    .put("robot", report.robotIndex() + 1)
                    .put("service", report.service())
                    .put("node", node));
            drivers.accept(describe(report.robotIndex(), "is driven by " + node));
        }
        if (node.equals(robot.node()) || report.event() == DriverReport.Event.COLOUR_SENT) {
            report.notify(this, table);
        }
    }

    /** @param drivers is called with a line of text */
    void driverLost(int index, String service, Throwable why, Consumer<String> drivers) {
        RobotRecord robot = robots.get(index);
        String node = robot.node();
        String reason = why.getMessage() == null ? why.toString() : why.getMessage();
        var line = Json.line(timeMicros(), "lost").put("robot", index + 1).put("service", service);
        log.write((node == null ? line : line.put("node", node)).put("why", reason));
        robot.lostDriver();
        robot.drivenBy(timeMicros(), null);
        drivers.accept(describe(index, "has lost its driver" + (node == null ? "" : " " + node) + ": " + reason));
    }

    private String describe(int robot, String what) {
        return String.format(Locale.ROOT, "%7.1f s  robot %d %s", timeMicros() / 1e6, robot + 1, what);
    }

    // ---- called by the run loop

    /** Records that the world was changed from outside before the interval that now begins. */
    public void intervened(String words) {
        log.write(Json.line(timeMicros(), "intervention").put("what", words));
    }

    /** The states that have begun, in their order. */
    public List<StateChange> states() {
        return Collections.unmodifiableList(states);
    }

    /** By index. */
    public List<RobotRecord> robots() {
        return robots;
    }

    /** Records the world before the first tick. */
    public void start(Snapshot snapshot) {
        last = snapshot;
        logStates();
        logPoses(snapshot);
    }

    /**
     * Records the world after a tick. Events of the services during the tick are written before the contacts and poses
     * that follow from them.
     */
    public void record(Snapshot snapshot) {
        logStates();
        logCharge();
        robots.forEach(RobotRecord::tickEnds);
        for (Contact contact : snapshot.contacts()) {
            logContact(contact);
        }
        last = snapshot;
        logPoses(snapshot);
    }

    /**
     * Writes the summary as the last line of the log.
     *
     * @param cutShort whether the run was interrupted before its end time
     */
    public RunResult finish(boolean cutShort) {
        var result =
                new RunResult(timeMicros(), table, List.copyOf(states), robots, new Messages(sent, received, tooLate));
        Json summary = result.toJson();
        log.write(cutShort ? summary.put("cutShort", "interrupted") : summary);
        return result;
    }

    /** Writes to the log that the run ended with an error. */
    public void fail() {
        log.write(Json.line(timeMicros(), "cutShort").put("cutShort", "failed"));
    }

    private long timeMicros() {
        return last == null ? 0 : last.timeMicros();
    }

    private void logStates() {
        for (; statesLogged < states.size(); statesLogged++) {
            StateChange change = states.get(statesLogged);
            var line = Json.line(change.timeMicros(), "state")
                    .put("state", change.state().number());
            if (change.seenBy() != null) {
                line.put("robot", change.seenBy() + 1);
            }
            log.write(line.put("colour", change.state().colour())
                    .put("services", Json.texts(change.state().services())));
            changes.accept(change.describe(table));
        }
    }

    /**
     * Logs a robot without exactly one service. The arbitrator's handshake guarantees one for every robot between two
     * readings.
     */
    private void logCharge() {
        if (table.states().isEmpty()) {
            return;
        }
        for (RobotRecord robot : robots) {
            if (robot.servicesInCharge().size() != 1) {
                robot.countChargeFault();
                log.write(Json.line(timeMicros(), "charge")
                        .put("robot", robot.index() + 1)
                        .put("services", Json.texts(robot.servicesInCharge())));
            }
        }
    }

    private void logContact(Contact contact) {
        RobotRecord robot = robots.get(contact.robot());
        robot.touched(contact);
        var line = Json.line(contact.timeMicros(), "contact")
                .put("robot", contact.robot() + 1)
                .put("service", robot.serviceName());
        if (contact.otherRobot() >= 0) {
            robots.get(contact.otherRobot()).touched(contact);
            line.put("otherRobot", contact.otherRobot() + 1);
        } else {
            line.put("obstacle", contact.other());
        }
        log.write(line);
    }

    private void logPoses(Snapshot snapshot) {
        boolean isLogged = robots.size() < MANY_ROBOTS || snapshot.timeMicros() % CROWD_POSE_MICROS == 0;
        if (isLogged) {
            logObstacles(snapshot);
            logGrippers(snapshot);
        }
        for (int index = 0; index < robots.size(); index++) {
            RobotReading reading = snapshot.robots().get(index);
            RobotRecord robot = robots.get(index);
            robot.moved(snapshot.timeMicros(), reading);
            if (!isLogged) {
                continue;
            }
            var line = Json.line(snapshot.timeMicros(), "pose")
                    .put("robot", index + 1)
                    .put("x", reading.pose().x())
                    .put("y", reading.pose().y())
                    .put("heading", reading.pose().headingRad())
                    .put("gap", reading.wallGapM())
                    .put("service", robot.serviceName());
            log.write(robot.node() == null ? line : line.put("node", robot.node()));
        }
    }

    /**
     * Logs the obstacles that have moved, come or gone, or were taken by a gripper or put down, since the last poses.
     */
    private void logObstacles(Snapshot snapshot) {
        SortedMap<Integer, Optional<Pose>> before = displaced;
        SortedMap<Integer, Integer> heldBefore = held;
        displaced = snapshot.displaced(world);
        held = snapshot.held();
        if (displaced.equals(before) && held.equals(heldBefore)) {
            return;
        }
        var indices = new TreeSet<>(before.keySet());
        indices.addAll(displaced.keySet());
        indices.addAll(heldBefore.keySet());
        indices.addAll(held.keySet());
        for (int index : indices) {
            ObstacleSpec obstacle = world.obstacles().get(index);
            Optional<Pose> start = Optional.of(obstacle.pose());
            Optional<Pose> pose = displaced.getOrDefault(index, start);
            Integer holder = held.get(index);
            if (!pose.equals(before.getOrDefault(index, start)) || !Objects.equals(holder, heldBefore.get(index))) {
                var line = Json.line(snapshot.timeMicros(), "obstacle")
                        .put("number", index + 1)
                        .put("obstacle", obstacle.name());
                pose.ifPresent(
                        there -> line.put("x", there.x()).put("y", there.y()).put("heading", there.headingRad()));
                log.write(holder == null ? line : line.put("heldBy", holder + 1));
            }
        }
    }

    /** Logs the grippers whose state is known and not that of their last line. */
    private void logGrippers(Snapshot snapshot) {
        for (int robot = 0; robot < grips.size(); robot++) {
            List<DeviceReading> devices = snapshot.robots().get(robot).devices();
            if (devices.isEmpty()) {
                continue; // as of most robots, at each tick
            }
            List<DeviceReading.Grip> before = grips.get(robot);
            List<DeviceReading.Grip> now = devices.stream()
                    .filter(DeviceReading.Grip.class::isInstance)
                    .map(DeviceReading.Grip.class::cast)
                    .toList();
            for (int i = 0; i < now.size(); i++) {
                DeviceReading.Grip grip = now.get(i);
                if (i >= before.size() || !grip.equals(before.get(i))) {
                    log.write(Json.line(snapshot.timeMicros(), "gripper")
                            .put("robot", robot + 1)
                            .put("gripper", i + 1)
                            .put("paddles", grip.paddles().name().toLowerCase(Locale.ROOT))
                            .put("outerBeam", grip.outerBeam())
                            .put("innerBeam", grip.innerBeam())
                            .put("holds", grip.holds()));
                }
            }
            grips.set(robot, now);
        }
    }
}
