package io.troupe.faults.history;

import io.troupe.faults.history.Event.ArbitratorEnded;
import io.troupe.faults.history.Event.Commanded;
import io.troupe.faults.history.Event.DriverFaultKind;
import io.troupe.faults.history.Event.LeaseLost;
import io.troupe.faults.history.Event.Rolled;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Reachability.Fault;
import io.troupe.faults.history.Violation.Rule;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Consumer;

/** Robot services: robots that lose their driver stop, get another one, and never have two. */
final class DriverRules {
    private static final long MILLI = 1_000_000;
    /** Half a second, and the tick in which the command arrived. */
    private static final long MOST_KEPT_MICROS = 600_000;

    private static final long LEASE_NANOS = 2_000 * MILLI;
    private static final long HALT_NANOS = 250 * MILLI;
    private static final long NEXT_DRIVER_NANOS = 5_000 * MILLI;
    /** Until an arbitrator that is cut off notices that: then the leases of its drivers are certainly over. */
    private static final long DISCOVERY_NANOS = 2_300 * MILLI;
    /** A busy machine, besides the pauses that are measured. */
    private static final long TOLERANCE_NANOS = 500 * MILLI;

    private static final long CHECK_NANOS = 50 * MILLI; // between the check of a lease and the command's line

    /** A service that drives a robot. */
    private record Drive(String process, int robot, int number) {}

    /** The first and the last command of a drive. */
    private record Span(Drive drive, Entry first, Entry last) {}

    private record Tick(long worldMicros) {}

    private final History history;
    private final Pauses pauses;
    private final Reachability reachability;
    private final Consumer<Violation> violations;
    private final Map<Integer, List<Entry>> commands = new TreeMap<>(); // by robot
    private final Map<DriverFaultKind, Long> nextDriverMillis = new EnumMap<>(DriverFaultKind.class);
    private long worstKeptMicros;

    DriverRules(History history, Pauses pauses, Consumer<Violation> violations) {
        this.history = history;
        this.pauses = pauses;
        this.reachability = new Reachability(history);
        this.violations = violations;
    }

    DriverRules check() {
        for (Entry entry : history.entries()) {
            if (entry.event() instanceof Commanded command) {
                commands.computeIfAbsent(command.robot(), robot -> new ArrayList<>())
                        .add(entry);
            }
        }
        checkStanding();
        commands.values().forEach(this::checkOneDriver);
        commands.values().forEach(this::checkDrivenAgain);
        checkLeases();
        checkEnds();
        return this;
    }

    private static Commanded command(Entry entry) {
        return (Commanded) entry.event();
    }

    // ---- a robot stands

    private void checkStanding() {
        Tick tick = null; // the last one
        Map<Integer, Tick> before = new HashMap<>(); // by robot: the tick before its last speed
        Map<Integer, Entry> last = new HashMap<>(); // by robot: its last speed
        for (Entry entry : history.entries()) {
            if (entry.event() instanceof Commanded(int robot, int drive, String service, boolean moving) && moving) {
                if (tick != null) {
                    before.put(robot, tick);
                }
                last.put(robot, entry);
            } else if (entry.event() instanceof Rolled rolled) {
                tick = new Tick(rolled.worldMicros());
                Entry command = last.get(rolled.robot());
                if (rolled.moving() && command != null) {
                    checkKept(rolled, entry, before.getOrDefault(rolled.robot(), tick), command);
                } else if (rolled.moving()) {
                    violations.accept(new Violation(
                            Rule.STANDS, "robot " + rolled.robot() + " moves without a driver", List.of(entry)));
                }
            }
        }
    }

    private void checkKept(Rolled rolled, Entry entry, Tick before, Entry command) {
        long pausedNanos = paused(entry.process(), command.nanos(), entry.nanos())
                + paused(command.process(), command.nanos(), command.nanos() + TOLERANCE_NANOS);
        long keptMicros = rolled.worldMicros() - before.worldMicros - pausedNanos / 1_000;
        worstKeptMicros = Math.max(worstKeptMicros, keptMicros);
        if (keptMicros > MOST_KEPT_MICROS) {
            violations.accept(new Violation(
                    Rule.STANDS,
                    "robot " + rolled.robot() + " moves " + keptMicros / 1_000 + " ms after the tick before its last"
                            + " speed was sent",
                    List.of(command, entry)));
        }
    }

    private long paused(String process, long fromNanos, long toNanos) {
        return toNanos - fromNanos - pauses.runningNanos(process, fromNanos, toNanos);
    }

    // ---- one driver

    private void checkOneDriver(List<Entry> ofRobot) {
        Map<Drive, Span> spans = new HashMap<>();
        for (Entry entry : ofRobot) {
            Commanded command = command(entry);
            var drive = new Drive(entry.process(), command.robot(), command.drive());
            spans.merge(drive, new Span(drive, entry, entry), (a, b) -> new Span(drive, a.first, b.last));
        }
        Span latest = null;
        for (Span span : spans.values().stream()
                .sorted((a, b) -> Long.compare(a.first.nanos(), b.first.nanos()))
                .toList()) {
            if (latest != null && span.first.nanos() < latest.last.nanos()) {
                violations.accept(new Violation(
                        Rule.ONE_DRIVER,
                        "robot " + span.drive.robot + " has two drivers for "
                                + (Math.min(latest.last.nanos(), span.last.nanos()) - span.first.nanos()) / MILLI
                                + " ms",
                        List.of(latest.first, span.first, latest.last, span.last)));
            }
            if (latest == null || span.last.nanos() > latest.last.nanos()) {
                latest = span;
            }
        }
    }

    // ---- another driver

    private void checkDrivenAgain(List<Entry> ofRobot) {
        Entry before = null;
        for (Entry entry : ofRobot) {
            if (reachability.isCutOff(entry)) {
                continue;
            }
            if (before != null) {
                checkGap(before, entry);
            }
            before = entry;
        }
    }

    private void checkGap(Entry before, Entry next) {
        long worst = 0;
        for (Reachability.Interval interval : reachability.available()) {
            long from = Math.max(before.nanos(), interval.fromNanos());
            long to = Math.min(next.nanos(), interval.toNanos());
            if (from < to) {
                long running =
                        to - from - paused(next.process(), from, to) - paused(reachability.arbitratorAt(to), from, to);
                worst = Math.max(worst, running);
            }
        }
        long millis = worst / MILLI;
        reachability
                .lastFaultBefore(next.nanos())
                .ifPresent(fault -> nextDriverMillis.merge(fault.kind(), millis, Math::max));
        if (worst > NEXT_DRIVER_NANOS + TOLERANCE_NANOS) {
            violations.accept(new Violation(
                    Rule.DRIVEN_AGAIN,
                    "robot " + command(next).robot() + " has another driver after " + millis + " ms",
                    List.of(before, next)));
        }
    }

    // ---- leases

    private void checkLeases() {
        Map<Drive, Entry> lost = new HashMap<>();
        for (Entry entry : history.entries()) {
            if (entry.event() instanceof LeaseLost(int robot, int number)) {
                lost.put(new Drive(entry.process(), robot, number), entry);
            } else if (entry.event() instanceof Commanded command) {
                Entry over = lost.get(new Drive(entry.process(), command.robot(), command.drive()));
                if (over != null
                        && (command.moving()
                                || pauses.runningNanos(entry.process(), over.nanos(), entry.nanos())
                                        > HALT_NANOS + CHECK_NANOS)) {
                    violations.accept(new Violation(
                            Rule.LEASE,
                            entry.process() + " sends a speed after the end of its lease",
                            List.of(over, entry)));
                }
            }
        }
        for (Fault fault : reachability.faults()) {
            if (fault.stopsRenewals()) {
                checkNotRenewed(fault);
            }
        }
    }

    private void checkNotRenewed(Fault fault) {
        long over = fault.brokenNanos() + LEASE_NANOS + CHECK_NANOS;
        long until = Math.min(fault.endedNanos(), reachability.nextArbitratorAfter(fault.brokenNanos()));
        for (List<Entry> ofRobot : commands.values()) {
            ofRobot.stream()
                    .filter(entry -> entry.nanos() < until && command(entry).moving())
                    .filter(entry -> entry.nanos() - paused(entry.process(), over, entry.nanos()) > over)
                    .findFirst()
                    .ifPresent(entry -> violations.accept(new Violation(
                            Rule.LEASE,
                            entry.process() + " sends a speed " + (entry.nanos() - fault.brokenNanos()) / MILLI
                                    + " ms after its arbitrator was gone",
                            List.of(fault.began(), entry))));
        }
    }

    // ---- ends

    private void checkEnds() {
        for (Entry entry : history.entries()) {
            if (entry.event() instanceof ArbitratorEnded(String type, String message)) {
                boolean isClear =
                        type.equals("MissingServiceException") && !message.isBlank() && !message.contains("\n");
                if (!isClear) {
                    violations.accept(new Violation(Rule.CLEAR_END, "the error is not clear", List.of(entry)));
                }
                long from = entry.nanos() - NEXT_DRIVER_NANOS;
                if (reachability.available().stream()
                        .anyMatch(each -> each.fromNanos() <= from && entry.nanos() <= each.toNanos())) {
                    violations.accept(
                            new Violation(Rule.CLEAR_END, "a provider could be reached all the time", List.of(entry)));
                }
            }
        }
        for (Reachability.Interval alone : reachability.alone()) {
            long nanos = alone.toNanos()
                    - alone.fromNanos()
                    - paused(reachability.arbitratorAt(alone.toNanos()), alone.fromNanos(), alone.toNanos());
            if (nanos > NEXT_DRIVER_NANOS + DISCOVERY_NANOS + TOLERANCE_NANOS) {
                violations.accept(new Violation(
                        Rule.CLEAR_END,
                        "an arbitrator has no provider for " + nanos / MILLI + " ms, and does not end",
                        reachability.lastFaultBefore(alone.toNanos()).stream()
                                .map(Fault::began)
                                .toList()));
            }
        }
    }

    /** The longest time on the world's clock for which a robot moved after the tick before its last speed. */
    long worstKeptMillis() {
        return worstKeptMicros / 1_000;
    }

    /** The longest time without a driver, by the fault before, while a provider could be reached. */
    Map<DriverFaultKind, Long> nextDriverMillis() {
        return nextDriverMillis;
    }
}
