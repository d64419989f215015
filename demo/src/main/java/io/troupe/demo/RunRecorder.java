package io.troupe.demo;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Contact;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Consumer;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Records a run: writes {@code run.jsonl} and collects the {@link RunResult}.
 *
 * <p><b>Threads.</b> The services call it on the actor space's thread, the run loop on the thread that advances the
 * world. In lock step the two never call at the same time, and each tick publishes the writes of one thread to the
 * other.
 */
final class RunRecorder implements ServiceObserver, Arbitrator.StateListener {
    /**
     * From this number of robots on, a run is reported as a crowd: the summary has sums and extremes, and the log has
     * poses once a second instead of at every tick.
     */
    static final int MANY_ROBOTS = 11;

    private static final long CROWD_POSE_MICROS = 1_000_000;
    private static final double CROWD_PATH_STEP_M = 0.25;

    private final SubsumptionTable table;
    private final RunLog log;
    private final Consumer<String> changes;
    private final List<RobotRecord> robots;
    private final List<StateChange> states = new ArrayList<>();
    private final Messages messages = new Messages();
    private int statesLogged;
    private Snapshot last;

    RunRecorder(WorldSpec world, SubsumptionTable table, RunLog log, Consumer<String> changes) {
        this.table = table;
        this.log = log;
        this.changes = changes;
        this.robots = IntStream.range(0, world.robots().size())
                .mapToObj(index -> new RobotRecord(index, world.robots().size() < MANY_ROBOTS ? 0 : CROWD_PATH_STEP_M))
                .toList();
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
        messages.sent++;
    }

    @Override
    public void colourReceived(int robot, int colour) {
        messages.received++;
    }

    @Override
    public void colourTooLate(int robot, int colour) {
        messages.tooLate++;
    }

    @Override
    public void stateStarted(State state, @Nullable Integer seenBy) {
        states.add(new StateChange(last == null ? 0 : last.timeMicros(), state, seenBy));
    }

    // ---- called by the run loop

    /** Records the world before the first tick. */
    void start(Snapshot snapshot) {
        last = snapshot;
        logStates();
        logPoses(snapshot);
    }

    /**
     * Records the world after a tick. Events of the services during the tick are written before the contacts and poses
     * that follow from them.
     */
    void record(Snapshot snapshot) {
        logStates();
        logCharge();
        robots.forEach(RobotRecord::tickEnds);
        for (Contact contact : snapshot.contacts()) {
            logContact(contact);
        }
        last = snapshot;
        logPoses(snapshot);
    }

    /** @param cutShort whether the run was interrupted before its end time */
    RunResult finish(boolean cutShort) {
        var result = new RunResult(last.timeMicros(), table, List.copyOf(states), robots, messages);
        Json summary = result.toJson();
        log.write(cutShort ? summary.put("cutShort", "interrupted") : summary);
        return result;
    }

    /** Writes to the log that the run ended with an error. */
    void fail() {
        log.write(Json.line(last == null ? 0 : last.timeMicros(), "cutShort").put("cutShort", "failed"));
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
        for (RobotRecord robot : robots) {
            if (robot.servicesInCharge().size() != 1) {
                robot.countChargeFault();
                log.write(Json.line(last.timeMicros(), "charge")
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
        for (int index = 0; index < robots.size(); index++) {
            RobotReading reading = snapshot.robots().get(index);
            RobotRecord robot = robots.get(index);
            robot.moved(snapshot.timeMicros(), reading);
            if (robots.size() >= MANY_ROBOTS && snapshot.timeMicros() % CROWD_POSE_MICROS != 0) {
                continue;
            }
            log.write(Json.line(snapshot.timeMicros(), "pose")
                    .put("robot", index + 1)
                    .put("x", reading.pose().x())
                    .put("y", reading.pose().y())
                    .put("heading", reading.pose().headingRad())
                    .put("gap", reading.wallGapM())
                    .put("service", robot.serviceName()));
        }
    }

    /** Counts messages that carry a colour. */
    static final class Messages {
        private long sent;
        private long received;
        private long tooLate;

        /** Sent by colour finders. */
        long sent() {
            return sent;
        }

        /** Received by the arbitrator. */
        long received() {
            return received;
        }

        /** Received after the state of their sender had ended. */
        long tooLate() {
            return tooLate;
        }
    }

    /** The start of a state. */
    record StateChange(
            long timeMicros, State state, @Nullable Integer seenBy) {
        private static final int LEAST_CAUSE_WIDTH = 18;

        /** A line for the terminal, with the table's colour names. */
        String describe(SubsumptionTable table) {
            return String.format(
                    Locale.ROOT,
                    "%7.1f s  %-" + causeWidth(table) + "s state %d: %s",
                    timeMicros / 1e6,
                    cause(table),
                    state.number(),
                    state.services().size() < MANY_ROBOTS ? assignment() : headcount());
        }

        /** The width of the column for the cause, so that the text after it is aligned. */
        private static int causeWidth(SubsumptionTable table) {
            int longest = table.states().stream()
                    .mapToInt(each -> table.colourName(each.colour()).length())
                    .max()
                    .orElse(0);
            return Math.max(LEAST_CAUSE_WIDTH, "robot  sees ".length() + ("" + table.robots()).length() + longest);
        }

        /** What started the state. */
        String cause(SubsumptionTable table) {
            return seenBy == null ? "start" : "robot " + (seenBy + 1) + " sees " + table.colourName(state.colour());
        }

        private String headcount() {
            Map<String, Long> robots = state.services().stream()
                    .collect(Collectors.groupingBy(Service::name, TreeMap::new, Collectors.counting()));
            return robots.entrySet().stream()
                    .map(each -> each.getValue() + " " + each.getKey())
                    .collect(Collectors.joining(", "));
        }

        private String assignment() {
            var assignment = new StringBuilder();
            for (int robot = 0; robot < state.services().size(); robot++) {
                assignment
                        .append(robot == 0 ? "" : ", ")
                        .append("robot ")
                        .append(robot + 1)
                        .append(' ')
                        .append(state.services().get(robot));
            }
            return assignment.toString();
        }
    }
}
