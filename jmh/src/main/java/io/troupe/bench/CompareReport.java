package io.troupe.bench;

import java.util.List;
import java.util.Locale;

/**
 * Formats the results as Markdown: a table of the workloads that are compared, and one of those that show how soon a
 * sleeping thread runs.
 */
record CompareReport(int rounds, long seed, Results results) {
    static final String NOT_RANKED = "wake-up of a thread, not ranked";
    private static final String HEAD = """
            | workload | contender | ns per operation | ratio to the limit, same round | bytes per operation | retained bytes per actor |
            |---|---|---|---|---|---|
            """;

    /** The tables: nanoseconds and ratios as median (lower quartile..upper quartile), bytes as median. */
    String table() {
        var text = new StringBuilder();
        text.append(format(
                "Java %s, %d processors, %d rounds, seed %d%n%n",
                Runtime.version(), Runtime.getRuntime().availableProcessors(), rounds, seed));
        rows(text, workloads(true));
        var wakeUps = workloads(false);
        if (!wakeUps.isEmpty()) {
            text.append(format("%nThe %s:%n%n", NOT_RANKED));
            rows(text, wakeUps);
        }
        return text.toString();
    }

    private List<Workload> workloads(boolean ranked) {
        return results.turns().keySet().stream()
                .filter(each -> each.isRanked() == ranked)
                .toList();
    }

    private void rows(StringBuilder text, List<Workload> workloads) {
        if (!workloads.isEmpty()) {
            text.append(HEAD);
        }
        for (Workload workload : workloads) {
            for (String name : results.turns().get(workload).keySet()) {
                text.append(row(workload, name));
            }
        }
    }

    private String row(Workload workload, String name) {
        Double retained = results.retained(workload, name);
        return format(
                "| %s | %s | %s | %s | %s | %s |%n",
                workload.label(),
                name,
                results.nanos(workload, name).text(CompareReport::number),
                results.ratio(workload, name).text(CompareReport::number),
                bytes(results.bytes(workload, name).median()),
                retained == null ? "" : bytes(retained));
    }

    private static String bytes(double value) {
        return format("%,d", Math.round(value));
    }

    static String number(double value) {
        return format(value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%,.0f", value);
    }

    static String format(String format, Object... values) {
        return String.format(Locale.ROOT, format, values);
    }
}
