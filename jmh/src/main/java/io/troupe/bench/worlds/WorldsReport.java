package io.troupe.bench.worlds;

import java.util.Locale;

/** Formats the results as a table in Markdown. */
record WorldsReport(BuildScene scene, int rounds, int turnMillis, long seed, WorldsResults results) {
    private static final String HEAD = """
            | robots | contender | simulated seconds per second | divided by ours, same round | bytes per physics step | bytes kept per robot |
            |---|---|---|---|---|---|
            """;

    /** The table: factors and ratios as median (lower quartile..upper quartile), bytes as median. */
    String table() {
        var text = new StringBuilder(format(
                "Scene %s, Java %s, %d processors, %d rounds of %d ms, seed %d%n%n",
                scene, Runtime.version(), Runtime.getRuntime().availableProcessors(), rounds, turnMillis, seed));
        text.append(HEAD);
        for (int robots : results.turns().keySet()) {
            for (WorldKind kind : results.turns().get(robots).keySet()) {
                text.append(row(robots, kind));
            }
        }
        return text.toString();
    }

    private String row(int robots, WorldKind kind) {
        Double retained = kind == WorldKind.TROUPE ? results.retainedBytes().get(robots) : null;
        return format(
                "| %,d | %s | %s | %s | %,d | %s |%n",
                robots,
                kind.label(),
                results.factor(robots, kind).text(WorldsReport::number),
                results.ratio(robots, kind).text(WorldsReport::number),
                Math.round(results.bytesPerStep(robots, kind).median()),
                retained == null ? "" : format("%,d", Math.round(retained)));
    }

    static String number(double value) {
        return format(value < 1 ? "%.3f" : value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%,.0f", value);
    }

    static String format(String format, Object... values) {
        return String.format(Locale.ROOT, format, values);
    }
}
