package io.troupe.faults.history;

import io.troupe.faults.history.Event.ArbitratorEnded;
import io.troupe.faults.history.Event.ArbitratorStarted;
import io.troupe.faults.history.Event.Broken;
import io.troupe.faults.history.Event.Connected;
import io.troupe.faults.history.Event.Disconnected;
import io.troupe.faults.history.Event.DriverFaultBegan;
import io.troupe.faults.history.Event.DriverFaultKind;
import io.troupe.faults.history.Event.FaultEnded;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.hosts.Hosts;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeSet;
import java.util.function.LongPredicate;

/** When an arbitrator could reach a provider of robot services: both are well, and connected with a server. */
final class Reachability {
    /** A time, without its end. */
    record Interval(long fromNanos, long toNanos) {
        private boolean has(long nanos) {
            return fromNanos <= nanos && nanos < toNanos;
        }
    }

    /** A fault, with the times when it was done and repaired. */
    record Fault(Entry began, long brokenNanos, long endedNanos) {
        private DriverFaultBegan event() {
            return (DriverFaultBegan) began.event();
        }

        DriverFaultKind kind() {
            return event().kind();
        }

        private boolean hits(String host) {
            return List.of(event().target().split(",")).contains(host);
        }

        private Interval interval() {
            return new Interval(began.nanos(), endedNanos);
        }

        private boolean cutsOff() {
            return switch (kind()) {
                case CUT_DRIVER, CUT_SPARE, CUT_DRIVER_FROM_ROBOTS -> true;
                default -> false;
            };
        }

        /** Whether leases run out. */
        boolean stopsRenewals() {
            return switch (kind()) {
                case KILL_ARBITRATOR, FREEZE_ARBITRATOR, CUT_ARBITRATOR, FREEZE_SERVER, KILL_SERVER -> true;
                default -> false;
            };
        }

        private boolean stopsArbitrator() {
            return kind() == DriverFaultKind.KILL_ARBITRATOR || kind() == DriverFaultKind.FREEZE_ARBITRATOR;
        }
    }

    private record Life(String process, Interval interval) {}

    private final List<Fault> faults = new ArrayList<>();
    private final List<Life> arbitrators = new ArrayList<>();
    private final Map<String, List<Interval>> unreachable = new HashMap<>(); // by host
    private final TreeSet<Long> moments = new TreeSet<>();
    private final List<Interval> available;
    private final List<Interval> alone;

    Reachability(History history) {
        history.entries().forEach(entry -> read(entry, history));
        for (Fault fault : faults) {
            for (String host : fault.event().target().split(",")) {
                block(host, fault.interval());
            }
        }
        arbitrators.forEach(life -> addMoments(life.interval));
        available = intervals(this::isAvailable);
        alone = intervals(nanos -> !isAvailable(nanos)
                && arbitrators.stream().anyMatch(life -> life.interval.has(nanos))
                && faults.stream()
                        .noneMatch(fault ->
                                fault.stopsArbitrator() && fault.interval().has(nanos)));
    }

    private void block(String host, Interval interval) {
        unreachable.computeIfAbsent(host, unused -> new ArrayList<>()).add(interval);
        addMoments(interval);
    }

    private void addMoments(Interval interval) {
        moments.add(interval.fromNanos);
        moments.add(interval.toNanos);
    }

    private void read(Entry entry, History history) {
        switch (entry.event()) {
            case DriverFaultBegan fault ->
                faults.add(new Fault(
                        entry,
                        first(history, entry, later -> later.event().equals(new Broken(fault.number()))),
                        first(history, entry, later -> later.event().equals(new FaultEnded(fault.number())))));
            case ArbitratorStarted started -> {
                long end = first(
                        history,
                        entry,
                        later -> later.event() instanceof ArbitratorEnded && isSame(later, entry)
                                || later.event() instanceof DriverFaultBegan fault
                                        && fault.kind() == DriverFaultKind.KILL_ARBITRATOR);
                arbitrators.add(new Life(entry.process(), new Interval(entry.nanos(), end)));
            }
            case Disconnected disconnected -> {
                long end = first(
                        history,
                        entry,
                        later -> later.event() instanceof Connected && isSame(later, entry)
                                || host(later).equals(host(entry)) && !isSame(later, entry));
                block(host(entry), new Interval(entry.nanos(), end));
            }
            default -> {}
        }
    }

    private static long first(History history, Entry after, java.util.function.Predicate<Entry> condition) {
        return history.entries().stream()
                .filter(entry -> entry.nanos() > after.nanos() && condition.test(entry))
                .mapToLong(Entry::nanos)
                .findFirst()
                .orElse(Long.MAX_VALUE);
    }

    private static boolean isSame(Entry a, Entry b) {
        return a.process().equals(b.process());
    }

    private static String host(Entry entry) {
        return entry.process().replaceFirst("-.*", "");
    }

    private boolean isAvailable(long nanos) {
        return isReachable(Hosts.SERVER, nanos)
                && isReachable(Hosts.ARBITRATOR, nanos)
                && arbitrators.stream().anyMatch(life -> life.interval.has(nanos))
                && Hosts.NODES.stream().anyMatch(host -> isReachable(host, nanos));
    }

    private boolean isReachable(String host, long nanos) {
        return unreachable.getOrDefault(host, List.of()).stream().noneMatch(interval -> interval.has(nanos));
    }

    /** The longest intervals in which a condition is true; it changes at {@link #moments} only. */
    private List<Interval> intervals(LongPredicate condition) {
        List<Interval> found = new ArrayList<>();
        long from = Long.MIN_VALUE;
        for (long moment : moments) {
            boolean isTrue = moment != Long.MAX_VALUE && condition.test(moment);
            if (isTrue && from == Long.MIN_VALUE) {
                from = moment;
            } else if (!isTrue && from != Long.MIN_VALUE) {
                found.add(new Interval(from, moment));
                from = Long.MIN_VALUE;
            }
        }
        return found;
    }

    List<Fault> faults() {
        return faults;
    }

    /** When a provider could be reached. */
    List<Interval> available() {
        return available;
    }

    /** When an arbitrator was alive without a provider that could be reached. */
    List<Interval> alone() {
        return alone;
    }

    /** The process of the arbitrator at, or just before, a moment. */
    String arbitratorAt(long nanos) {
        return arbitrators.stream()
                .filter(life -> life.interval.fromNanos <= nanos)
                .map(Life::process)
                .reduce("", (earlier, later) -> later);
    }

    long nextArbitratorAfter(long nanos) {
        return arbitrators.stream()
                .mapToLong(life -> life.interval.fromNanos)
                .filter(from -> from > nanos)
                .findFirst()
                .orElse(Long.MAX_VALUE);
    }

    Optional<Fault> lastFaultBefore(long nanos) {
        return faults.stream().filter(fault -> fault.began.nanos() < nanos).reduce((earlier, later) -> later);
    }

    /** Whether a command is sent by a process that does not reach the robots. */
    boolean isCutOff(Entry command) {
        return faults.stream()
                .anyMatch(fault -> fault.cutsOff()
                        && fault.hits(host(command))
                        && fault.interval().has(command.nanos()));
    }
}
