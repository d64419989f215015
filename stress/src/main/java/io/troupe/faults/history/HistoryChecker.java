package io.troupe.faults.history;

import io.troupe.faults.history.Event.DriverFaultKind;
import io.troupe.faults.history.Event.Memory;
import io.troupe.faults.history.Event.Surprise;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Violation.Rule;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

/** Checks the history of a run against all rules. */
public final class HistoryChecker {
    private static final long MOST_BYTES = 64L << 20;

    private final List<Violation> violations = new ArrayList<>();

    private HistoryChecker() {}

    /** Returns what the history breaks, in no particular order. */
    public static List<Violation> check(History history) {
        var checker = new HistoryChecker();
        var pauses = new Pauses(history);
        new CallRules(history, pauses, checker.violations::add).check();
        new StreamRules(history, checker.violations::add).check();
        new PublicationRules(history, pauses, checker.violations::add).check();
        new RobotRules(history, pauses, checker.violations::add).check();
        new DriverRules(history, pauses, checker.violations::add).check();
        history.entries().forEach(checker::checkAlone);
        return List.copyOf(checker.violations);
    }

    /** How long after its limit the slowest call was settled, without the pauses of its caller; negative if before. */
    public static long worstMillisBeyondLimit(History history) {
        return CallRules.worstMillisBeyondLimit(history);
    }

    /** The longest time on the world's clock for which a robot kept a speed without a new command. */
    public static long worstKeptMillis(History history) {
        return new RobotRules(history, new Pauses(history), violation -> {})
                .check()
                .worstKeptMillis();
    }

    /** The longest time on the world's clock for which a robot moved after its last driver's last speed. */
    public static long worstStopMillis(History history) {
        return driverRules(history).worstKeptMillis();
    }

    /** The longest time without a driver, by the fault before it, while a provider could be reached. */
    public static Map<DriverFaultKind, Long> nextDriverMillis(History history) {
        return driverRules(history).nextDriverMillis();
    }

    private static DriverRules driverRules(History history) {
        return new DriverRules(history, new Pauses(history), violation -> {}).check();
    }

    /** How many commands have reached a robot. */
    public static long commands(History history) {
        return new RobotRules(history, new Pauses(history), violation -> {})
                .check()
                .matched();
    }

    private void checkAlone(Entry entry) {
        if (entry.event() instanceof Memory(long bytes) && bytes > MOST_BYTES) {
            violations.add(new Violation(
                    Rule.MEMORY,
                    entry.process() + " uses " + (bytes >> 20) + " MiB, at most " + (MOST_BYTES >> 20) + " MiB allowed",
                    List.of(entry)));
        } else if (entry.event() instanceof Surprise(String what)) {
            violations.add(new Violation(Rule.SURPRISE, what, List.of(entry)));
        }
    }
}
