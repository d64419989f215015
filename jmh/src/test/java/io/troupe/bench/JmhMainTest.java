package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.openjdk.jmh.results.format.ResultFormatType;
import org.openjdk.jmh.runner.options.CommandLineOptions;
import org.openjdk.jmh.runner.options.Options;
import org.openjdk.jmh.runner.options.TimeValue;

class JmhMainTest {
    @TempDir
    Path folder;

    private final ByteArrayOutputStream errors = new ByteArrayOutputStream();

    private static Options options(String... arguments) throws Exception {
        return JmhMain.withDefaults(new CommandLineOptions(arguments));
    }

    @Test
    void noArguments_areAShortSet() throws Exception {
        Options options = options();
        assertThat(options.getIncludes()).contains("ActorBenchmark", "HopBenchmark");
        assertThat(options.getForkCount().get()).isEqualTo(1);
        assertThat(options.getWarmupIterations().get()).isEqualTo(3);
        assertThat(options.getMeasurementIterations().get()).isEqualTo(3);
        assertThat(options.getMeasurementTime().get()).isEqualTo(TimeValue.milliseconds(500));
        assertThat(options.shouldFailOnError().get()).isTrue();
        assertThat(options.getResult().get()).isEqualTo("out/jmh.json");
        assertThat(options.getResultFormat().get()).isEqualTo(ResultFormatType.JSON);
    }

    @Test
    void options_replaceTheDefaultsThatTheyName() throws Exception {
        Options options = options("-f", "2", "-i", "7", "-prof", "gc", "-foe", "false", "-rf", "csv", "-rff", "a.csv");
        assertThat(options.getIncludes()).contains("ActorBenchmark", "HopBenchmark");
        assertThat(options.getForkCount().get()).isEqualTo(2);
        assertThat(options.getMeasurementIterations().get()).isEqualTo(7);
        assertThat(options.getWarmupIterations().get()).isEqualTo(3);
        assertThat(options.getProfilers()).hasSize(1);
        assertThat(options.shouldFailOnError().get()).isFalse();
        assertThat(options.getResult().get()).isEqualTo("a.csv");
        assertThat(options.getResultFormat().get()).isEqualTo(ResultFormatType.CSV);
    }

    @Test
    void benchmarksThatAreNamed_runAsTheirAnnotationsSay() throws Exception {
        Options options = options("Hop", "-wi", "1");
        assertThat(options.getIncludes()).containsExactly("Hop");
        assertThat(options.getForkCount().hasValue()).isFalse();
        assertThat(options.getMeasurementTime().hasValue()).isFalse();
        assertThat(options.getWarmupIterations().get()).isEqualTo(1);
        assertThat(options.getResult().get()).isEqualTo("out/jmh.json");
    }

    @Test
    void run_writesItsResults() throws Exception {
        Path results = folder.resolve("new/jmh.json");
        assertThat(run("HopBenchmark.hop_floor", results, "-i", "1")).isZero();
        assertThat(results).content().contains("io.troupe.bench.HopBenchmark.hop_floor", "\"score\"");
    }

    @Test
    void benchmarkThatDoesNotExist_fails() throws Exception {
        assertThat(run("NoSuchBenchmark", folder.resolve("jmh.json"))).isEqualTo(1);
        assertThat(errors.toString()).contains("no benchmark matches", "NoSuchBenchmark");
    }

    /** A pool of no actors cannot be made. */
    @Test
    void runInWhichEveryBenchmarkFails_fails() throws Exception {
        Path results = folder.resolve("jmh.json");
        assertThat(run("compute_roundRobin", results, "-p", "actors=0")).isEqualTo(1);
        assertThat(run("compute_roundRobin", results, "-p", "actors=0", "-foe", "false"))
                .isEqualTo(1);
        assertThat(errors.toString())
                .endsWith("no benchmark ran to its end, expected one or more" + System.lineSeparator());
    }

    @Test
    void wrongOption_isAnErrorOfUsage() throws Exception {
        assertThat(run("Hop", folder.resolve("jmh.json"), "--no-such-option")).isEqualTo(2);
        assertThat(errors.toString()).contains("no-such-option");
    }

    /** In this JVM, with the shortest times, and its log in a file. */
    private int run(String benchmark, Path results, String... more) throws Exception {
        String log = folder.resolve("log").toString();
        List<String> all = new ArrayList<>(List.of(benchmark, "-f", "0", "-wi", "0", "-r", "1ms", "-o", log));
        all.addAll(List.of("-rff", results.toString()));
        all.addAll(List.of(more));
        return JmhMain.run(new PrintStream(errors, true, StandardCharsets.UTF_8), all.toArray(String[]::new));
    }
}
