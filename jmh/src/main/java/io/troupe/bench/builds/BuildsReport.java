package io.troupe.bench.builds;

import io.troupe.bench.BuildTable.Turn;
import io.troupe.bench.builds.BuildJvms.Name;
import io.troupe.bench.builds.BuildVerdict.Interval;
import io.troupe.bench.builds.BuildVerdict.Kind;
import io.troupe.bench.builds.BuildVerdict.Round;
import io.troupe.bench.builds.CompareBuilds.RowResult;
import io.troupe.tools.NatsServerProcess;
import io.troupe.tools.SampleStatistics;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.Function;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;

/** Formats the comparison of two builds as Markdown. */
record BuildsReport(CompareBuilds settings, String loadBefore) {
    private static final String HEAD = """

            | %s | before | now | by the clock | noise | by processor time | noise | result | bytes before | now | kept before | now |
            |---|--:|--:|--:|--:|--:|--:|---|--:|--:|--:|--:|
            """;
    /** Rows with more noise are named at the end. */
    private static final double MUCH_NOISE = 0.1;

    /** So that no time is zero, where clocks are coarse. */
    private static final double LEAST_NANOS = 1e-3;

    BuildsReport(CompareBuilds settings) {
        this(settings, Machine.load());
    }

    /** What is compared, where and how. */
    String head(BeforeBuild before) {
        int starts = settings.starts;
        return format(
                "%s%n%nBefore: %s%n%n%d starts of three JVMs for each part, %d rounds of about %d ms of processor time after %d ms, seed %d."
                        + " Intervals of the median have a confidence of %.1f %%.%n",
                Machine.text(),
                before.entries().stream().map(Path::toString).collect(Collectors.joining(", ")),
                starts,
                settings.rounds,
                settings.turnMillis,
                settings.warmUpMillis,
                settings.seed,
                100 * Interval.confidence(starts, Interval.rank(starts)));
    }

    String table(BuildPart part, List<RowResult> rows) {
        var text = new StringBuilder(format(HEAD, part));
        rows.forEach(each -> text.append(row(each)));
        return text.toString();
    }

    private static String row(RowResult result) {
        if (result.failure != null) {
            return format(
                    "| %s | | | | | | | cannot be compared: %s | | | | |%n",
                    result.row.name(),
                    String.valueOf(result.failure.getMessage()).replace("|", "\\|"));
        }
        BuildVerdict clock = clock(result);
        BuildVerdict processor = processor(result);
        return format(
                "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |%n",
                result.row.name(),
                nanos(median(result, Round::before, Turn::nanosEach)),
                nanos(median(result, Round::now, Turn::nanosEach)),
                text(clock.change()),
                noise(clock),
                text(processor.change()),
                noise(processor),
                result(result),
                bytes(median(result, Round::before, Turn::bytesEach)),
                bytes(median(result, Round::now, Turn::bytesEach)),
                kept(result, Name.BEFORE),
                kept(result, Name.NOW));
    }

    private static String result(RowResult result) {
        if (clock(result).kind() == Kind.TOO_FEW_STARTS) {
            return "not judged, fewer than " + BuildVerdict.LEAST_STARTS + " starts";
        }
        List<String> found = new ArrayList<>();
        if (has(Kind.MORE, result)) {
            found.add("**slower**");
        }
        if (has(Kind.LESS, result)) {
            found.add("faster");
        }
        return found.isEmpty() ? "no difference beyond noise" : String.join(" and ", found);
    }

    /** True by the clock or by the processor time. */
    private static boolean has(Kind kind, RowResult result) {
        return clock(result).kind() == kind || processor(result).kind() == kind;
    }

    private static BuildVerdict clock(RowResult result) {
        return BuildVerdict.of(result.starts, turn -> Math.max(LEAST_NANOS, turn.nanosEach()));
    }

    private static BuildVerdict processor(RowResult result) {
        return BuildVerdict.of(result.starts, turn -> Math.max(LEAST_NANOS, turn.processorNanosEach()));
    }

    /** One byte is added to each, since some rows allocate nothing. */
    private static BuildVerdict allocation(RowResult result) {
        return BuildVerdict.of(result.starts, turn -> 1 + turn.bytesEach());
    }

    private static double median(RowResult result, Function<Round<Turn>, Turn> build, ToDoubleFunction<Turn> figure) {
        return SampleStatistics.of(result.starts.stream()
                        .flatMap(List::stream)
                        .map(build)
                        .mapToDouble(figure)
                        .toArray())
                .median();
    }

    /** True if a row became slower, or does not run in this build. */
    static boolean isSlower(Map<BuildPart, List<RowResult>> results) {
        return results.values().stream()
                .flatMap(List::stream)
                .anyMatch(each -> each.failure == null ? has(Kind.MORE, each) : each.failure.isOfThisBuild());
    }

    /** The last lines: what became slower, faster, and so on. */
    String summary(Map<BuildPart, List<RowResult>> results, boolean lacksServer) {
        List<String> slower = new ArrayList<>();
        List<String> faster = new ArrayList<>();
        List<String> moreBytes = new ArrayList<>();
        List<String> fewerBytes = new ArrayList<>();
        List<String> failed = new ArrayList<>();
        List<String> noisy = new ArrayList<>();
        results.forEach((part, rows) -> {
            for (RowResult each : rows) {
                String name = part + ", " + each.row.name();
                if (each.failure != null) {
                    failed.add(name + " (" + each.failure.getMessage() + ")");
                    continue;
                }
                if (each.keptFailure != null) {
                    failed.add(name + ", bytes kept (" + each.keptFailure.getMessage() + ")");
                }
                add(clock(each), name + " by the clock", slower, faster);
                add(processor(each), name + " by processor time", slower, faster);
                add(allocation(each), name, moreBytes, fewerBytes);
                double noise = Math.min(clock(each).noise(), processor(each).noise());
                if (noise > MUCH_NOISE) {
                    noisy.add(name + format(" (%.0f %%)", 100 * noise));
                }
            }
        });
        if (lacksServer) {
            failed.add(BuildPart.BUS + ", over NATS (" + NatsServerProcess.HOW_TO_GET + ")");
        }
        return format("%nLoad average %s before and %s after.%n%n", loadBefore, Machine.load())
                + line("Slower", slower)
                + line("Faster", faster)
                + line("Allocates more", moreBytes)
                + line("Allocates less", fewerBytes)
                + line("Not compared", failed)
                + line("Noise above 10 %, so a smaller change would not be seen", noisy);
    }

    private static void add(BuildVerdict verdict, String name, List<String> more, List<String> less) {
        String text = name + " " + text(verdict.change()) + ", noise " + noise(verdict);
        switch (verdict.kind()) {
            case MORE -> more.add(text);
            case LESS -> less.add(text);
            case NO_DIFFERENCE, TOO_FEW_STARTS -> {}
        }
    }

    private static String line(String title, List<String> rows) {
        return format("* %s: %s%n", title, rows.isEmpty() ? "none" : String.join("; ", rows));
    }

    private static String noise(BuildVerdict verdict) {
        return format("%.0f %%", 100 * verdict.noise());
    }

    private static String text(Interval interval) {
        return format("%.2f (%.2f..%.2f)", interval.median(), interval.low(), interval.high());
    }

    private static String kept(RowResult result, Name build) {
        Double bytes = result.keptBytes.get(build);
        return bytes == null ? "" : bytes(bytes) + " per " + result.row.kept();
    }

    private static String bytes(double bytes) {
        return bytes < 1e5
                ? format("%,d", Math.round(bytes))
                : bytes < 1e7 ? format("%,.0f kB", bytes / 1e3) : format("%,.1f MB", bytes / 1e6);
    }

    private static String nanos(double nanos) {
        return nanos < 1e3
                ? number(nanos) + " ns"
                : nanos < 1e6 ? number(nanos / 1e3) + " us" : number(nanos / 1e6) + " ms";
    }

    private static String number(double value) {
        return format(value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%,.0f", value);
    }

    private static String format(String format, Object... values) {
        return String.format(Locale.ROOT, format, values);
    }
}
