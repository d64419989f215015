package io.troupe.faults;

import io.troupe.faults.history.Event;
import io.troupe.faults.history.Event.ArbitratorEnded;
import io.troupe.faults.history.Event.Called;
import io.troupe.faults.history.Event.Commanded;
import io.troupe.faults.history.Event.Delivered;
import io.troupe.faults.history.Event.DriverFaultBegan;
import io.troupe.faults.history.Event.DriverFaultKind;
import io.troupe.faults.history.Event.FaultBegan;
import io.troupe.faults.history.Event.FaultKind;
import io.troupe.faults.history.Event.Lost;
import io.troupe.faults.history.Event.StreamOpened;
import io.troupe.faults.history.History;
import io.troupe.faults.history.HistoryChecker;
import io.troupe.faults.history.Violation;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * What all runs of one kind have shown: a row for each kind of fault, and totals.
 *
 * @param <K> the kinds of faults
 */
abstract sealed class FaultReport<K extends Enum<K>> {
    /** The faults of one kind. */
    private static final class Row {
        int faults;
        int violations;
        int ends;
        long worstMillis;
    }

    private final Map<K, Row> rows;
    private final List<Violation> violations = new ArrayList<>();
    private final List<Long> seeds = new ArrayList<>();

    private FaultReport(Class<K> kinds) {
        rows = new EnumMap<>(kinds);
    }

    /** Adds a run with the violations that were found in its history. */
    void add(long seed, History history, List<Violation> found) {
        seeds.add(seed);
        violations.addAll(found);
        var last = new Row();
        for (History.Entry entry : history.entries()) {
            K began = faultBeganBy(entry.event());
            if (began != null) {
                last = row(began);
                last.faults++;
            } else {
                count(entry.event(), last);
            }
        }
        found.forEach(violation -> before(violation, history).violations++);
    }

    /** The kind of the fault that begins with an event, or null if none does. */
    abstract @Nullable K faultBeganBy(Event event);

    /**
     * Counts an event that begins no fault.
     *
     * @param last the row of the last fault before it
     */
    abstract void count(Event event, Row last);

    /** The line of the evidence before which the fault began that may have caused a violation. */
    abstract History.Entry decisive(List<History.Entry> evidence);

    private Row before(Violation violation, History history) {
        long nanos = violation.evidence().isEmpty()
                ? Long.MAX_VALUE
                : decisive(violation.evidence()).nanos();
        var last = new Row();
        for (History.Entry entry : history.entries()) {
            K began = faultBeganBy(entry.event());
            if (began != null && entry.nanos() <= nanos) {
                last = row(began);
            }
        }
        return last;
    }

    final Row row(K kind) {
        return rows.computeIfAbsent(kind, unused -> new Row());
    }

    final Map<K, Row> rows() {
        return rows;
    }

    final int faults() {
        return rows.values().stream().mapToInt(row -> row.faults).sum();
    }

    final boolean isEmpty() {
        return seeds.isEmpty();
    }

    final List<Violation> violations() {
        return List.copyOf(violations);
    }

    final List<Long> seeds() {
        return seeds;
    }

    final String lastLine() {
        return "seeds %d to %d%n".formatted(seeds.getFirst(), seeds.getLast());
    }

    final String name(K kind) {
        return kind.name().toLowerCase(Locale.ROOT).replace('_', ' ');
    }

    /** The report as one line of JSON. */
    abstract String json();

    /** Faults of hosts, links and processes of a bus, with calls, topics and streams. */
    static final class OfBus extends FaultReport<FaultKind> {
        private long calls;
        private long streams;
        private long delivered;
        private long reported;
        private long commands;
        private long worstKeptMillis;
        private long worstMillisBeyondLimit = Long.MIN_VALUE;

        OfBus() {
            super(FaultKind.class);
        }

        @Override
        void add(long seed, History history, List<Violation> found) {
            super.add(seed, history, found);
            commands += HistoryChecker.commands(history);
            worstKeptMillis = Math.max(worstKeptMillis, HistoryChecker.worstKeptMillis(history));
            worstMillisBeyondLimit = Math.max(worstMillisBeyondLimit, HistoryChecker.worstMillisBeyondLimit(history));
        }

        @Override
        @Nullable
        FaultKind faultBeganBy(Event event) {
            return event instanceof FaultBegan fault ? fault.kind() : null;
        }

        @Override
        void count(Event event, Row last) {
            switch (event) {
                case Called called -> calls++;
                case StreamOpened opened -> streams++;
                case Delivered values -> delivered += values.count();
                case Lost values -> reported += values.count();
                default -> {}
            }
        }

        @Override
        History.Entry decisive(List<History.Entry> evidence) {
            return evidence.getFirst();
        }

        @Override
        public String toString() {
            var text = new StringBuilder();
            text.append("%n%-16s %6s %10s%n".formatted("fault", "count", "violations"));
            rows().forEach((kind, row) ->
                    text.append("%-16s %6d %10d%n".formatted(name(kind), row.faults, row.violations)));
            text.append(
                    "%-16s %6d %10d%n".formatted("all", faults(), violations().size()));
            text.append("%,d calls and %,d streams; %,d values delivered, %,d reported as lost or replaced%n"
                    .formatted(calls, streams, delivered, reported));
            text.append("the slowest call was settled %d ms after its limit (0 ms = exactly then)%n"
                    .formatted(worstMillisBeyondLimit));
            text.append("%,d speeds have reached a robot; it kept none for longer than %d ms%n"
                    .formatted(commands, worstKeptMillis));
            return text.append(lastLine()).toString();
        }

        @Override
        String json() {
            String faults = rows().entrySet().stream()
                    .map(entry -> "\"%s\": {\"count\": %d, \"violations\": %d}"
                            .formatted(name(entry.getKey()), entry.getValue().faults, entry.getValue().violations))
                    .collect(Collectors.joining(", "));
            return ("{\"faults\": {%s}, \"violations\": %d, \"calls\": %d, \"streams\": %d, \"delivered\": %d,"
                            + " \"reported\": %d, \"worstMillisBeyondLimit\": %d, \"commands\": %d,"
                            + " \"worstKeptMillis\": %d, \"seeds\": %s}%n")
                    .formatted(
                            faults,
                            violations().size(),
                            calls,
                            streams,
                            delivered,
                            reported,
                            worstMillisBeyondLimit,
                            commands,
                            worstKeptMillis,
                            seeds());
        }
    }

    /** Faults of the main job over hosts: of robot services, their arbitrator, and the links between them. */
    static final class OfDrivers extends FaultReport<DriverFaultKind> {
        private long commands;
        private long worstStopMillis;

        OfDrivers() {
            super(DriverFaultKind.class);
        }

        @Override
        void add(long seed, History history, List<Violation> found) {
            super.add(seed, history, found);
            HistoryChecker.nextDriverMillis(history)
                    .forEach((kind, millis) -> row(kind).worstMillis = Math.max(row(kind).worstMillis, millis));
            worstStopMillis = Math.max(worstStopMillis, HistoryChecker.worstStopMillis(history));
        }

        @Override
        @Nullable
        DriverFaultKind faultBeganBy(Event event) {
            return event instanceof DriverFaultBegan fault ? fault.kind() : null;
        }

        @Override
        void count(Event event, Row last) {
            switch (event) {
                case ArbitratorEnded ended -> last.ends++;
                case Commanded command -> commands++;
                default -> {}
            }
        }

        @Override
        History.Entry decisive(List<History.Entry> evidence) {
            return evidence.getLast();
        }

        private long worstMillis() {
            return rows().values().stream()
                    .mapToLong(row -> row.worstMillis)
                    .max()
                    .orElse(0);
        }

        @Override
        public String toString() {
            var text = new StringBuilder();
            text.append(
                    "%n%-22s %6s %10s %6s %18s%n".formatted("fault", "count", "violations", "ends", "next driver, ms"));
            rows().forEach((kind, row) -> text.append("%-22s %6d %10d %6d %18d%n"
                    .formatted(name(kind), row.faults, row.violations, row.ends, row.worstMillis)));
            text.append(
                    "%-22s %6d %10d%n".formatted("all", faults(), violations().size()));
            text.append("%,d speeds were sent; no robot moved for longer than %d ms after its driver's last one%n"
                    .formatted(commands, worstStopMillis));
            text.append(
                    "no robot waited longer than %d ms for a driver that could be reached%n".formatted(worstMillis()));
            return text.append(lastLine()).toString();
        }

        @Override
        String json() {
            String faults = rows().entrySet().stream()
                    .map(entry -> "\"%s\": {\"count\": %d, \"violations\": %d, \"ends\": %d, \"nextDriverMillis\": %d}"
                            .formatted(
                                    name(entry.getKey()),
                                    entry.getValue().faults,
                                    entry.getValue().violations,
                                    entry.getValue().ends,
                                    entry.getValue().worstMillis))
                    .collect(Collectors.joining(", "));
            return "{\"driverFaults\": {%s}, \"violations\": %d, \"speeds\": %d, \"worstStopMillis\": %d, \"seeds\": %s}%n"
                    .formatted(faults, violations().size(), commands, worstStopMillis, seeds());
        }
    }
}
