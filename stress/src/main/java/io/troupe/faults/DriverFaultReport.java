package io.troupe.faults;

import io.troupe.faults.history.Event.ArbitratorEnded;
import io.troupe.faults.history.Event.Commanded;
import io.troupe.faults.history.Event.DriverFaultBegan;
import io.troupe.faults.history.Event.DriverFaultKind;
import io.troupe.faults.history.History;
import io.troupe.faults.history.HistoryChecker;
import io.troupe.faults.history.Violation;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/** What all runs with robot services have shown. */
final class DriverFaultReport {
    /** The faults of one kind. */
    private static final class Row {
        int faults;
        int violations;
        int ends;
        long worstMillis;
    }

    private final Map<DriverFaultKind, Row> rows = new EnumMap<>(DriverFaultKind.class);
    private final List<Violation> violations = new ArrayList<>();
    private final List<Long> seeds = new ArrayList<>();
    private long commands;
    private long worstStopMillis;

    void add(long seed, History history, List<Violation> found) {
        seeds.add(seed);
        violations.addAll(found);
        var last = new Row();
        for (History.Entry entry : history.entries()) {
            if (entry.event() instanceof DriverFaultBegan fault) {
                last = row(fault.kind());
                last.faults++;
            } else if (entry.event() instanceof ArbitratorEnded) {
                last.ends++;
            } else if (entry.event() instanceof Commanded) {
                commands++;
            }
        }
        found.forEach(violation -> before(violation, history).violations++);
        HistoryChecker.nextDriverMillis(history)
                .forEach((kind, millis) -> row(kind).worstMillis = Math.max(row(kind).worstMillis, millis));
        worstStopMillis = Math.max(worstStopMillis, HistoryChecker.worstStopMillis(history));
    }

    private Row row(DriverFaultKind kind) {
        return rows.computeIfAbsent(kind, unused -> new Row());
    }

    private Row before(Violation violation, History history) {
        long nanos = violation.evidence().isEmpty()
                ? Long.MAX_VALUE
                : violation.evidence().getLast().nanos();
        Row last = new Row();
        for (History.Entry entry : history.entries()) {
            if (entry.event() instanceof DriverFaultBegan fault && entry.nanos() <= nanos) {
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

    private int faults() {
        return rows.values().stream().mapToInt(row -> row.faults).sum();
    }

    private long worstMillis() {
        return rows.values().stream().mapToLong(row -> row.worstMillis).max().orElse(0);
    }

    @Override
    public String toString() {
        var text = new StringBuilder();
        text.append("%n%-22s %6s %10s %6s %18s%n".formatted("fault", "count", "violations", "ends", "next driver, ms"));
        rows.forEach((kind, row) -> text.append("%-22s %6d %10d %6d %18d%n"
                .formatted(name(kind), row.faults, row.violations, row.ends, row.worstMillis)));
        text.append("%-22s %6d %10d%n".formatted("all", faults(), violations.size()));
        text.append("%,d speeds were sent; no robot moved for longer than %d ms after its driver's last one%n"
                .formatted(commands, worstStopMillis));
        text.append("no robot waited longer than %d ms for a driver that could be reached%n".formatted(worstMillis()));
        text.append("seeds %d to %d%n".formatted(seeds.getFirst(), seeds.getLast()));
        return text.toString();
    }

    private static String name(DriverFaultKind kind) {
        return kind.name().toLowerCase(Locale.ROOT).replace('_', ' ');
    }

    String json() {
        var text = new StringBuilder("{\"driverFaults\": {");
        rows.forEach((kind, row) -> text.append(rows.keySet().iterator().next() == kind ? "" : ", ")
                .append("\"%s\": {\"count\": %d, \"violations\": %d, \"ends\": %d, \"nextDriverMillis\": %d}"
                        .formatted(name(kind), row.faults, row.violations, row.ends, row.worstMillis)));
        return text.append("}, \"violations\": %d, \"speeds\": %d, \"worstStopMillis\": %d, \"seeds\": %s}%n"
                        .formatted(violations.size(), commands, worstStopMillis, seeds))
                .toString();
    }
}
