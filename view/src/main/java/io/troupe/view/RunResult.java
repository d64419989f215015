package io.troupe.view;

import io.troupe.common.text.Plural;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Function;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * The result of a run: what a {@link RecordedRun} or a {@link RunRecorder} returns.
 *
 * <p><b>Threads.</b> It belongs to the thread that got it.
 *
 * @param endMicros simulated length of the run
 * @param states in order of their start
 * @param robots by index
 */
public record RunResult(
        long endMicros, SubsumptionTable table, List<StateChange> states, List<RobotRecord> robots, Messages messages) {
    private static final int TITLE_WIDTH = 38;

    private static final String SERVICES_TITLE = "readings with no or several services";
    private static final String NO_CYCLE_TITLE = "readings without a cycle";
    private static final String STAY_TITLE = "longest stay within 5 cm";

    /** How often the state has changed. */
    int switches() {
        return Math.max(0, states.size() - 1);
    }

    /** How often a state started. */
    public long visits(State state) {
        return states.stream().filter(change -> change.state().equals(state)).count();
    }

    Json toJson() {
        var json = Json.line(endMicros, "summary").put("switches", switches());
        json.put(
                "states",
                Json.objects(table.states().stream()
                        .map(state -> new Json()
                                .put("state", state.number())
                                .put("visits", visits(state))
                                .put("seconds", secondsIn(state)))
                        .toList()));
        return json.put(
                "robots", Json.objects(robots.stream().map(RunResult::toJson).toList()));
    }

    private static Json toJson(RobotRecord robot) {
        var loops = new Json();
        robot.loops().forEach(loops::put);
        return new Json()
                .put("robot", robot.index() + 1)
                .put("distance", robot.distanceM())
                .put("closest", robot.closestM())
                .put("wallContacts", robot.wallContacts())
                .put("wallContactsWhileFollowing", robot.followingContacts())
                .put("robotContacts", robot.robotContacts())
                .put("chargeFaults", robot.chargeFaults())
                .put("loops", loops);
    }

    /** The simulated length in seconds, such as {@code 300.0}. */
    public String duration() {
        return Json.seconds(endMicros);
    }

    /** The figures of all robots, messages and states, in lines for a terminal. */
    public String summary() {
        var text = new StringBuilder();
        text.append(robots.size() < RunRecorder.MANY_ROBOTS ? eachRobot() : CrowdSummary.of(robots, table));
        line(text, "(a cycle: a service takes a reading of the sensors and commands a speed)");
        text.append(stuck());
        line(text, "%s", messageSummary());
        for (State state : table.states()) {
            line(
                    text,
                    "state %d (%s): %s, %.1f s",
                    state.number(),
                    table.colourName(state.colour()),
                    Plural.of(visits(state), "time"),
                    secondsIn(state));
        }
        return text.toString();
    }

    private String eachRobot() {
        var text = new StringBuilder();
        String row = titleFormat(table) + "%s";
        line(text, row, "", columns(robot -> "robot " + (robot.index() + 1)));
        line(text, row, "distance driven", columns(robot -> String.format(Locale.ROOT, "%.1f m", robot.distanceM())));
        line(
                text,
                row,
                "closest approach to a wall",
                columns(robot -> String.format(Locale.ROOT, "%.3f m", robot.closestM())));
        line(text, row, "contacts with walls and boxes", columns(robot -> "" + robot.wallContacts()));
        line(text, row, "  while following a wall", columns(robot -> "" + robot.followingContacts()));
        line(text, row, "contacts with a robot", columns(robot -> "" + robot.robotContacts()));
        for (Service service : table.services()) {
            line(
                    text,
                    row,
                    loopsTitle(service),
                    columns(robot -> "" + robot.loops().getOrDefault(service.name(), 0L)));
        }
        line(text, row, SERVICES_TITLE, columns(robot -> "" + robot.chargeFaults()));
        line(text, row, NO_CYCLE_TITLE, columns(robot -> "" + robot.ticksWithoutCycle()));
        line(text, row, STAY_TITLE, columns(robot -> seconds(robot.longestStay().micros())));
        return text.toString();
    }

    /** Reports robots that made no progress, and when. Of a crowd only the longest case is reported. */
    private String stuck() {
        var stuck = robots.stream()
                .filter(robot -> robot.longestStay().isStuck())
                .sorted(Comparator.comparingLong(robot -> -robot.longestStay().micros()))
                .toList();
        var text = new StringBuilder();
        int reported = robots.size() < RunRecorder.MANY_ROBOTS ? stuck.size() : Math.min(1, stuck.size());
        for (RobotRecord robot : stuck.subList(0, reported)) {
            var stay = robot.longestStay();
            line(
                    text,
                    "robot %d made no way for %s: from %s to %s it stayed within 5 cm while %s drove it",
                    robot.index() + 1,
                    seconds(stay.micros()),
                    seconds(stay.fromMicros()),
                    seconds(stay.toMicros()),
                    stay.service());
        }
        if (robots.size() >= RunRecorder.MANY_ROBOTS && stuck.size() > 1) {
            line(text, "%d robots made no way for %s or longer", stuck.size(), seconds(RobotRecord.STUCK_MICROS));
        }
        return text.toString();
    }

    private static String seconds(long micros) {
        return String.format(Locale.ROOT, "%.1f s", micros / 1e6);
    }

    private static String loopsTitle(Service service) {
        return "cycles of " + service;
    }

    /** Format of the first column: as wide as the longest title, which may contain the name of a service. */
    private static String titleFormat(SubsumptionTable table) {
        int longest = table.services().stream()
                .mapToInt(service -> loopsTitle(service).length())
                .max()
                .orElse(0);
        return "%-" + Math.max(TITLE_WIDTH, longest + 1) + "s";
    }

    private String messageSummary() {
        int changes = switches();
        String each = changes == 0
                ? ""
                : String.format(Locale.ROOT, ", %.1f a state change", (double) messages.sent() / changes);
        return String.format(
                Locale.ROOT,
                "colours sent by colour finders: %d in %s%s; %d received, %d of them too late",
                messages.sent(),
                Plural.of(changes, "state change"),
                each,
                messages.received(),
                messages.tooLate());
    }

    private double secondsIn(State state) {
        long micros = 0;
        for (int i = 0; i < states.size(); i++) {
            if (states.get(i).state().equals(state)) {
                micros += (i + 1 < states.size() ? states.get(i + 1).timeMicros() : endMicros)
                        - states.get(i).timeMicros();
            }
        }
        return micros / 1e6;
    }

    private String columns(Function<RobotRecord, String> value) {
        return robots.stream()
                .map(robot -> String.format("%12s", value.apply(robot)))
                .collect(Collectors.joining());
    }

    private static void line(StringBuilder text, String format, Object... values) {
        text.append(String.format(Locale.ROOT, format, values)).append(System.lineSeparator());
    }

    /**
     * Messages that carry a colour.
     *
     * @param sent by colour finders
     * @param received by the arbitrator
     * @param tooLate received after the state of their sender had ended
     */
    public record Messages(long sent, long received, long tooLate) {}

    /**
     * The start of a state.
     *
     * @param seenBy index of the robot that detected the colour; null for the first state
     */
    public record StateChange(
            long timeMicros, State state, @Nullable Integer seenBy) {
        private static final int LEAST_CAUSE_WIDTH = 18;

        /** A line for the terminal, with the table's colour names. */
        public String describe(SubsumptionTable table) {
            return String.format(
                    Locale.ROOT,
                    "%7.1f s  %-" + causeWidth(table) + "s state %d: %s",
                    timeMicros / 1e6,
                    cause(table),
                    state.number(),
                    state.services().size() < RunRecorder.MANY_ROBOTS ? assignment() : headcount());
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
        public String cause(SubsumptionTable table) {
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

    /** The summary of a run with many robots: sum, mean, minimum and maximum of each figure. */
    private static final class CrowdSummary {
        private final List<RobotRecord> robots;
        private final String columns;
        private final StringBuilder text = new StringBuilder();

        private CrowdSummary(List<RobotRecord> robots, SubsumptionTable table) {
            this.robots = robots;
            this.columns = titleFormat(table) + "%12s%12s%24s%24s";
        }

        static String of(List<RobotRecord> robots, SubsumptionTable table) {
            var summary = new CrowdSummary(robots, table);
            summary.line(robots.size() + " robots", "all", "mean", "least", "most");
            summary.row("distance driven, m", 1, RobotRecord::distanceM);
            summary.extremes("closest approach to a wall, m", 3, "", RobotRecord::closestM);
            summary.row("contacts with walls and boxes", 0, RobotRecord::wallContacts);
            summary.row("  while following a wall", 0, RobotRecord::followingContacts);
            summary.row("contacts with a robot", 0, RobotRecord::robotContacts);
            for (Service service : table.services()) {
                summary.row(loopsTitle(service), 0, robot -> robot.loops().getOrDefault(service.name(), 0L));
            }
            summary.row(SERVICES_TITLE, 0, RobotRecord::chargeFaults);
            summary.row(NO_CYCLE_TITLE, 0, RobotRecord::ticksWithoutCycle);
            summary.extremes(
                    STAY_TITLE + ", s", 1, "", robot -> robot.longestStay().micros() / 1e6);
            return summary.text.toString();
        }

        private void row(String title, int decimals, ToDoubleFunction<RobotRecord> figure) {
            double sum = robots.stream().mapToDouble(figure).sum();
            extremes(title, decimals, number(sum, decimals), figure);
        }

        private void extremes(String title, int decimals, String all, ToDoubleFunction<RobotRecord> figure) {
            double mean = robots.stream().mapToDouble(figure).average().orElse(0);
            var least = robots.stream().min(Comparator.comparingDouble(figure)).orElseThrow();
            var most = robots.stream().max(Comparator.comparingDouble(figure)).orElseThrow();
            boolean same = figure.applyAsDouble(least) == figure.applyAsDouble(most);
            line(
                    title,
                    all,
                    number(mean, Math.max(1, decimals)),
                    number(figure.applyAsDouble(least), decimals) + (same ? "" : whose(least)),
                    number(figure.applyAsDouble(most), decimals) + (same ? "" : whose(most)));
        }

        private static String whose(RobotRecord robot) {
            return " (robot " + (robot.index() + 1) + ")";
        }

        private static String number(double value, int decimals) {
            return String.format(Locale.ROOT, "%,." + decimals + "f", value);
        }

        private void line(Object... values) {
            text.append(String.format(Locale.ROOT, columns, values)).append(System.lineSeparator());
        }
    }
}
