package io.troupe.view;

import io.troupe.common.text.Plural;
import io.troupe.services.subsumption.Mode;
import io.troupe.view.RunResult.StateChange;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.OptionalInt;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * Compares runs of the same world and seed in the three modes; promise mode is the reference.
 *
 * {@snippet :
 * var results = new EnumMap<Mode, RunResult>(Mode.class);
 * for (Mode mode : Mode.values()) {
 *     var run = new RecordedRun(scenario, table, settings.withMode(mode));
 *     results.put(mode, run.run(folder.resolve(mode + ".jsonl")));
 * }
 * var comparison = new ModeComparison(results);
 * Files.writeString(folder.resolve("modes.svg"), Pictures.modes(comparison, comparison.finding()));
 * }
 *
 * <p><b>Errors.</b> Without a run in promise mode only {@link #table} works; the other methods throw
 * {@link IllegalArgumentException}.
 *
 * @param results one per mode, all of the same length
 */
public record ModeComparison(Map<Mode, RunResult> results) {
    private static final int COLUMN = 32; // three columns and the row number take 100 characters

    /** @throws IllegalArgumentException if there is no run in this mode */
    public RunResult result(Mode mode) {
        RunResult result = results.get(mode);
        if (result == null) {
            throw new IllegalArgumentException("there is no run in " + mode + " mode, only in " + results.keySet());
        }
        return result;
    }

    /** Index of the first state change that is missing in promise mode or differs from it. */
    public OptionalInt firstDifference(Mode mode) {
        var ours = result(mode).states();
        var promises = result(Mode.PROMISE).states();
        int most = Math.max(ours.size(), promises.size());
        return IntStream.range(0, most)
                .filter(index -> index >= ours.size()
                        || index >= promises.size()
                        || !ours.get(index).equals(promises.get(index)))
                .findFirst();
    }

    /** Time of the earlier of the two state changes that differ. */
    long firstDifferenceMicros(Mode mode, int index) {
        return Math.min(microsOf(mode, index), microsOf(Mode.PROMISE, index));
    }

    private long microsOf(Mode mode, int index) {
        var states = result(mode).states();
        return index < states.size() ? states.get(index).timeMicros() : Long.MAX_VALUE;
    }

    /** The first tick after which the pose of a robot differs from promise mode. */
    OptionalInt firstTickApart(Mode mode) {
        return IntStream.range(0, result(mode).robots().getFirst().path().size())
                .filter(tick -> IntStream.range(0, result(mode).robots().size())
                        .anyMatch(robot -> metresApart(mode, robot, tick) > 0 || turnedApart(mode, robot, tick)))
                .findFirst();
    }

    private double metresApart(Mode mode, int robot, int tick) {
        var here = sample(mode, robot, tick).pose();
        var there = sample(Mode.PROMISE, robot, tick).pose();
        return StrictMath.hypot(here.x() - there.x(), here.y() - there.y());
    }

    private boolean turnedApart(Mode mode, int robot, int tick) {
        return sample(mode, robot, tick).pose().headingRad()
                != sample(Mode.PROMISE, robot, tick).pose().headingRad();
    }

    private RobotRecord.Sample sample(Mode mode, int robot, int tick) {
        return result(mode).robots().get(robot).path().get(tick);
    }

    /** The full report for the terminal: the table of states, then the differences. */
    public String text() {
        var text = new StringBuilder(table());
        line(text, "* the first change that promise mode does not have in the same way");
        line(text, "");
        for (Mode mode : results.keySet()) {
            line(text, "%s mode: %s", mode, difference(mode));
        }
        return text.toString();
    }

    /** One line: which modes have the same states as promise mode, and until when. */
    public String finding() {
        String others = results.keySet().stream()
                .filter(mode -> mode != Mode.PROMISE)
                .map(mode -> firstDifference(mode).isEmpty()
                        ? mode + " does not differ"
                        : String.format(
                                Locale.ROOT,
                                "%s differs from %.1f s on",
                                mode,
                                firstDifferenceMicros(
                                                mode, firstDifference(mode).getAsInt())
                                        / 1e6))
                .collect(Collectors.joining(", "));
        return "States compared with promise mode: " + others;
    }

    /** The states of all modes side by side. */
    public String table() {
        var text = new StringBuilder();
        line(text, "when each state began, its number, and why");
        line(text, "%-4s%s", "", columns(mode -> mode + " mode"));
        int rows = results.values().stream()
                .mapToInt(result -> result.states().size())
                .max()
                .orElse(0);
        for (int row = 0; row < rows; row++) {
            int index = row;
            line(text, "%-4d%s", index, columns(mode -> cell(mode, index)));
        }
        return text.toString();
    }

    private String cell(Mode mode, int index) {
        var states = result(mode).states();
        if (index >= states.size()) {
            return "";
        }
        StateChange change = states.get(index);
        boolean marked =
                results.containsKey(Mode.PROMISE) && firstDifference(mode).orElse(-1) == index;
        return String.format(
                Locale.ROOT,
                "%s%6.1f s %d: %s",
                marked ? "*" : " ",
                change.timeMicros() / 1e6,
                change.state().number(),
                change.cause(result(mode).table()));
    }

    private String columns(Function<Mode, String> value) {
        return results.keySet().stream()
                .map(mode -> String.format("%-" + COLUMN + "." + (COLUMN - 1) + "s", value.apply(mode)))
                .collect(Collectors.joining())
                .stripTrailing();
    }

    /** The number of messages of a mode, and how and why it differs from promise mode. */
    String difference(Mode mode) {
        var result = result(mode);
        String messages = String.format(
                Locale.ROOT,
                "%s with colours for %s",
                Plural.of(result.messages().sent(), "message"),
                Plural.of(result.states().size() - 1, "state change"));
        var apart = firstTickApart(mode);
        if (mode == Mode.PROMISE) {
            return messages + ".";
        }
        if (apart.isEmpty()) {
            return "the same states at the same times and the same trajectories as in promise mode, since a switch takes place between the same two readings; "
                    + messages + ".";
        }
        String text = messages + "; " + waiting(mode)
                + (mode == Mode.SYNC ? ", as each waits for the cycles of the others" : "")
                + ". The robots are elsewhere from "
                + seconds(sample(mode, 0, apart.getAsInt()).timeMicros()) + " on";
        var difference = firstDifference(mode);
        return difference.isEmpty()
                ? text + ", but the states are the same."
                : text + "; at the first other change, " + seconds(firstDifferenceMicros(mode, difference.getAsInt()))
                        + ", " + distances(mode, firstDifferenceMicros(mode, difference.getAsInt())) + ".";
    }

    private String waiting(Mode mode) {
        return result(mode).robots().stream()
                .map(robot -> String.format(
                        Locale.ROOT,
                        "robot %d at %d of %d",
                        robot.index() + 1,
                        robot.path().size() - 1 - robot.ticksWithoutCycle(),
                        robot.path().size() - 1))
                .collect(Collectors.joining(", ", "readings at which its service has a cycle: ", ""));
    }

    private String distances(Mode mode, long micros) {
        int tick = (int) result(mode).robots().getFirst().path().stream()
                .takeWhile(sample -> sample.timeMicros() < micros)
                .count();
        return IntStream.range(0, result(mode).robots().size())
                .mapToObj(robot ->
                        String.format(Locale.ROOT, "robot %d by %.2f m", robot + 1, metresApart(mode, robot, tick)))
                .collect(Collectors.joining(", ", "they are apart from those of promise mode: ", ""));
    }

    private static String seconds(long micros) {
        return String.format(Locale.ROOT, "%.1f s", micros / 1e6);
    }

    private static void line(StringBuilder text, String format, Object... values) {
        text.append(String.format(Locale.ROOT, format, values)).append(System.lineSeparator());
    }

    List<Mode> modes() {
        return List.copyOf(results.keySet());
    }
}
