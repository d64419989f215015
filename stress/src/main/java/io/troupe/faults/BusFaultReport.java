package io.troupe.faults;

import io.troupe.faults.history.Event.Called;
import io.troupe.faults.history.Event.Delivered;
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

/** What all runs have shown. */
final class BusFaultReport {
    /** The faults of one kind. */
    private static final class Row {
        int faults;
        int violations;
    }

    private final Map<FaultKind, Row> rows = new EnumMap<>(FaultKind.class);
    private final List<Violation> violations = new ArrayList<>();
    private final List<Long> seeds = new ArrayList<>();
    private long calls;
    private long streams;
    private long delivered;
    private long reported;
    private long commands;
    private long worstKeptMillis;
    private long worstMillisBeyondLimit = Long.MIN_VALUE;

    void add(long seed, History history, List<Violation> found) {
        seeds.add(seed);
        violations.addAll(found);
        for (var entry : history.entries()) {
            switch (entry.event()) {
                case FaultBegan fault -> row(fault.kind()).faults++;
                case Called called -> calls++;
                case StreamOpened opened -> streams++;
                case Delivered values -> delivered += values.count();
                case Lost values -> reported += values.count();
                default -> {}
            }
        }
        found.forEach(violation -> before(violation, history).violations++);
        commands += HistoryChecker.commands(history);
        worstKeptMillis = Math.max(worstKeptMillis, HistoryChecker.worstKeptMillis(history));
        worstMillisBeyondLimit = Math.max(worstMillisBeyondLimit, HistoryChecker.worstMillisBeyondLimit(history));
    }

    private Row row(FaultKind kind) {
        return rows.computeIfAbsent(kind, unused -> new Row());
    }

    /** The kind of the last fault that began before the first line of the evidence, which may have caused it. */
    private Row before(Violation violation, History history) {
        long nanos = violation.evidence().isEmpty()
                ? Long.MAX_VALUE
                : violation.evidence().getFirst().nanos();
        Row last = new Row();
        for (var entry : history.entries()) {
            if (entry.event() instanceof FaultBegan fault && entry.nanos() <= nanos) {
                last = row(fault.kind());
            }
        }
        return last;
    }

    boolean isEmpty() {
        return seeds.isEmpty();
    }

    List<Violation> violations() {
        return List.copyOf(violations);
    }

    @Override
    public String toString() {
        var text = new StringBuilder();
        text.append("%n%-16s %6s %10s%n".formatted("fault", "count", "violations"));
        rows.forEach((kind, row) -> text.append("%-16s %6d %10d%n".formatted(name(kind), row.faults, row.violations)));
        int all = rows.values().stream().mapToInt(row -> row.faults).sum();
        text.append("%-16s %6d %10d%n".formatted("all", all, violations.size()));
        text.append("%,d calls and %,d streams; %,d values delivered, %,d reported as lost or replaced%n"
                .formatted(calls, streams, delivered, reported));
        text.append("the slowest call was settled %d ms after its limit (0 ms = exactly then)%n"
                .formatted(worstMillisBeyondLimit));
        text.append("%,d speeds have reached a robot; it kept none for longer than %d ms%n"
                .formatted(commands, worstKeptMillis));
        text.append("seeds %d to %d%n".formatted(seeds.getFirst(), seeds.getLast()));
        return text.toString();
    }

    private static String name(FaultKind kind) {
        return kind.name().toLowerCase(Locale.ROOT).replace('_', ' ');
    }

    String json() {
        var text = new StringBuilder("{\"faults\": {");
        rows.forEach((kind, row) -> text.append(rows.keySet().iterator().next() == kind ? "" : ", ")
                .append("\"%s\": {\"count\": %d, \"violations\": %d}"
                        .formatted(name(kind), row.faults, row.violations)));
        return text.append(
                        "}, \"violations\": %d, \"calls\": %d, \"streams\": %d, \"delivered\": %d, \"reported\": %d, \"worstMillisBeyondLimit\": %d, \"commands\": %d, \"worstKeptMillis\": %d, \"seeds\": %s}%n"
                                .formatted(
                                        violations.size(),
                                        calls,
                                        streams,
                                        delivered,
                                        reported,
                                        worstMillisBeyondLimit,
                                        commands,
                                        worstKeptMillis,
                                        seeds))
                .toString();
    }
}
