package io.troupe.bench.bus;

import io.troupe.bench.bus.BusWorkload.Part;
import java.util.Locale;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;

/** Formats the results as tables in Markdown: figures as median (lower quartile..upper quartile), bytes as median. */
record BusReport(BusResults results) {
    private static final double MEDIAN = 0.5;
    private static final double HIGH = 0.99;

    /** A table for each part that was measured. */
    String tables() {
        var text = new StringBuilder();
        if (!results.measured(Part.CODEC).isEmpty()) {
            codec(text);
        }
        if (!results.measured(Part.ASK).isEmpty()) {
            asks(text);
            percentiles(text);
        }
        if (!results.measured(Part.PUBLISH).isEmpty()) {
            publications(text);
        }
        if (!results.nodes().isEmpty()) {
            nodes(text);
        }
        return text.toString();
    }

    private void codec(StringBuilder text) {
        head(
                text,
                "value and way | contender | ns of processor per value | ours divided by Jackson's, same round | bytes of a value"
                        + " | bytes allocated");
        rows(
                Part.CODEC,
                (workload, contender) -> text.append(format(
                        "| %s | %s | %s | %s | %,.0f | %,.0f |%n",
                        workload.label(),
                        contender.label(),
                        text(workload, contender, turn -> 1_000 * turn.micros(MEDIAN)),
                        ratio(workload, contender, turn -> turn.micros(MEDIAN)),
                        results.encoded(workload, contender),
                        median(workload, contender, BusTurn::bytes))));
    }

    private void asks(StringBuilder text) {
        head(
                text,
                "request and reply | contender | p50, us | p99, us | p50 divided by raw NATS's, same round | p99 divided"
                        + " | processor us | bytes allocated | bytes of the request's frame");
        rows(
                Part.ASK,
                (workload, contender) -> text.append(format(
                        "| %s | %s | %s | %s | %s | %s | %s | %,.0f | %,.0f |%n",
                        workload.label(),
                        contender.label(),
                        text(workload, contender, turn -> turn.micros(MEDIAN)),
                        text(workload, contender, turn -> turn.micros(HIGH)),
                        ratio(workload, contender, turn -> turn.micros(MEDIAN)),
                        ratio(workload, contender, turn -> turn.micros(HIGH)),
                        number(median(workload, contender, BusTurn::processorMicros)),
                        median(workload, contender, BusTurn::bytes),
                        results.encoded(workload, contender))));
    }

    private void percentiles(StringBuilder text) {
        head(
                text,
                "request and reply, us | contender | "
                        + BusTurn.SHARES.stream().map(BusReport::percentile).collect(Collectors.joining(" | ")));
        rows(
                Part.ASK,
                (workload, contender) -> text.append(format(
                        "| %s | %s | %s |%n",
                        workload.label(),
                        contender.label(),
                        BusTurn.SHARES.stream()
                                .map(share -> number(median(workload, contender, turn -> turn.micros(share))))
                                .collect(Collectors.joining(" | ")))));
    }

    private void publications(StringBuilder text) {
        head(
                text,
                "publications | contender | per second | ours divided by raw NATS's, same round | processor us"
                        + " | bytes allocated | bytes of a frame");
        rows(
                Part.PUBLISH,
                (workload, contender) -> text.append(format(
                        "| %s | %s | %s | %s | %s | %,.0f | %,.0f |%n",
                        workload.label(),
                        contender.label(),
                        text(workload, contender, turn -> 1e6 / turn.micros(MEDIAN)),
                        ratio(workload, contender, turn -> 1e6 / turn.micros(MEDIAN)),
                        number(median(workload, contender, BusTurn::processorMicros)),
                        median(workload, contender, BusTurn::bytes),
                        results.encoded(workload, contender))));
    }

    private void nodes(StringBuilder text) {
        head(
                text,
                "node with " + BusMemory.PORTS + " ports and " + BusMemory.TOPICS + " topics | bytes kept | threads");
        results.nodes()
                .forEach((node, cost) ->
                        text.append(format("| %s | %,.0f | %.0f |%n", node.label(), cost.heapBytes(), cost.threads())));
    }

    private static void head(StringBuilder text, String columns) {
        text.append(format("%n| %s |%n|%s%n", columns, "---|".repeat(columns.split("\\|").length)));
    }

    private interface Row {
        void add(BusWorkload workload, BusContender contender);
    }

    private void rows(Part part, Row row) {
        for (BusWorkload workload : results.measured(part)) {
            part.contenders().forEach(contender -> row.add(workload, contender));
        }
    }

    private String text(BusWorkload workload, BusContender contender, ToDoubleFunction<BusTurn> figure) {
        return results.of(workload, contender, figure).text(BusReport::number);
    }

    private double median(BusWorkload workload, BusContender contender, ToDoubleFunction<BusTurn> figure) {
        return results.of(workload, contender, figure).median();
    }

    private String ratio(BusWorkload workload, BusContender contender, ToDoubleFunction<BusTurn> figure) {
        return contender == workload.part().contenders().getLast()
                ? ""
                : results.ratio(workload, contender, figure).text(BusReport::number);
    }

    /** As p99 or p99.9. */
    static String percentile(double share) {
        return "p" + format("%.1f", 100 * share).replaceFirst("\\.0$", "");
    }

    static String number(double value) {
        return format(value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%,.0f", value);
    }

    static String format(String format, Object... values) {
        return String.format(Locale.ROOT, format, values);
    }
}
