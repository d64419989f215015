package io.troupe.bench;

import java.io.IOException;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.openjdk.jmh.Main;
import org.openjdk.jmh.results.format.ResultFormatType;
import org.openjdk.jmh.runner.NoBenchmarksException;
import org.openjdk.jmh.runner.Runner;
import org.openjdk.jmh.runner.RunnerException;
import org.openjdk.jmh.runner.options.CommandLineOptionException;
import org.openjdk.jmh.runner.options.CommandLineOptions;
import org.openjdk.jmh.runner.options.Options;
import org.openjdk.jmh.runner.options.OptionsBuilder;
import org.openjdk.jmh.runner.options.TimeValue;

/**
 * JMH's command line with defaults. Without the name of a benchmark, a short set runs with short settings, about a
 * minute; an option replaces the setting that it names. Benchmarks that are named have the settings of their
 * annotations, as in JMH. The results are also written as JSON, to {@value #RESULTS} unless {@code -rff} names a file.
 *
 * <p><b>Errors.</b> A benchmark that fails ends the run, unless {@code -foe false} is given. The exit status is 1 then,
 * and when no benchmark ran; with an option that JMH does not know it is 2.
 */
public final class JmhMain {
    static final String RESULTS = "out/jmh.json";
    /** Messages, questions, creation, callbacks and pools; without {@link OptionBenchmark}, which has 14 variants. */
    private static final List<String> SHORT_SET =
            List.of("ActorBenchmark", "HopBenchmark", "CallbackBenchmark", "PoolBenchmark.compute_roundRobin");

    private static final TimeValue SHORT_TIME = TimeValue.milliseconds(500);

    private JmhMain() {}

    public static void main(String[] arguments) throws IOException {
        System.exit(run(System.err, arguments));
    }

    /** The exit status; errors are printed in one line. */
    static int run(PrintStream errors, String... arguments) throws IOException {
        try {
            var given = new CommandLineOptions(arguments);
            if (given.shouldHelp()
                    || given.shouldList()
                    || given.shouldListWithParams()
                    || given.shouldListProfilers()
                    || given.shouldListResultFormats()) {
                Main.main(arguments);
                return 0;
            }
            Options options = withDefaults(given);
            Path folder = Path.of(options.getResult().get()).toAbsolutePath().getParent();
            if (folder != null) {
                Files.createDirectories(folder);
            }
            if (new Runner(options).run().isEmpty()) {
                errors.println("jmh: no benchmark ran to its end, expected one or more");
                return 1;
            }
            return 0;
        } catch (CommandLineOptionException wrong) {
            errors.println("jmh: " + wrong.getMessage() + "; -h lists the options");
            return 2;
        } catch (NoBenchmarksException none) {
            errors.println("jmh: no benchmark matches " + String.join(" ", arguments) + "; -l lists them");
            return 1;
        } catch (RunnerException failure) { // its cause has been printed with the benchmark that failed
            errors.println("jmh: " + failure.getMessage());
            return 1;
        }
    }

    /** What is given, and defaults for the rest. */
    static Options withDefaults(CommandLineOptions given) {
        var options = new OptionsBuilder();
        options.parent(given);
        if (!given.shouldFailOnError().hasValue()) {
            options.shouldFailOnError(true);
        }
        if (!given.getResult().hasValue()) {
            options.result(RESULTS);
        }
        if (!given.getResultFormat().hasValue()) {
            options.resultFormat(ResultFormatType.JSON);
        }
        if (given.getIncludes().isEmpty()) {
            SHORT_SET.forEach(options::include);
            if (!given.getForkCount().hasValue()) {
                options.forks(1);
            }
            if (!given.getWarmupIterations().hasValue()) {
                options.warmupIterations(3);
            }
            if (!given.getWarmupTime().hasValue()) {
                options.warmupTime(SHORT_TIME);
            }
            if (!given.getMeasurementIterations().hasValue()) {
                options.measurementIterations(3);
            }
            if (!given.getMeasurementTime().hasValue()) {
                options.measurementTime(SHORT_TIME);
            }
        }
        return options.build();
    }
}
