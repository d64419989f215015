package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.tools.SampleStatistics;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.MatchResult;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** What tests of several benchmarks share. */
public final class BenchmarkTests {
    private BenchmarkTests() {}

    /** Reads the options of a benchmark. */
    public static <T> T parsed(T benchmark, String... arguments) {
        BenchmarkCommand.of(benchmark).parseArgs(arguments);
        return benchmark;
    }

    /** The error output of a command line with a wrong option; the benchmark does not run. */
    public static String errorOf(Object benchmark, String... arguments) {
        var err = new StringWriter();
        int status = BenchmarkCommand.of(benchmark).setErr(new PrintWriter(err)).execute(arguments);
        assertThat(status).as(err.toString()).isEqualTo(2);
        return err.toString();
    }

    /** The lines with results in the documentation that have this form. */
    public static List<MatchResult> documentedRows(String pattern) throws IOException {
        var row = Pattern.compile(pattern);
        return Files.readAllLines(Path.of("..", "docs", "benchmarks-method.md")).stream()
                .map(row::matcher)
                .filter(Matcher::matches)
                .map(Matcher::toMatchResult)
                .toList();
    }

    public static double number(String text) {
        return Double.parseDouble(text.replace(",", ""));
    }

    /** The statistics of five values whose median and quartiles are in this group and the following two. */
    public static SampleStatistics quartiles(MatchResult row, int group) {
        double lower = number(row.group(group + 1));
        double upper = number(row.group(group + 2));
        return SampleStatistics.of(lower, lower, number(row.group(group)), upper, upper);
    }

    /** Compares a drawing with that of the documentation; {@code -Dfigures=write} writes it anew. */
    public static void assertDocumented(String figure, String svg) throws IOException {
        Path documented = Path.of("..", "docs", "figures", figure);
        if ("write".equals(System.getProperty("figures"))) {
            Files.writeString(documented, svg);
        }
        assertThat(documented).hasContent(svg);
    }
}
