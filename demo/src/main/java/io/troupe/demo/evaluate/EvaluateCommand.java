package io.troupe.demo.evaluate;

import io.troupe.demo.terminal.TerminalLine;
import io.troupe.services.subsumption.Mode;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe evaluate}: Figures 15, 18, 21, 22 and 23 again. */
@Command(
        name = "evaluate",
        description = "Measures what section 4 of the paper measured, and sets what the paper says beside what comes out.",
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class EvaluateCommand implements Callable<Integer> {
    private static final Path HOME = Path.of(System.getProperty("troupe.home", ""));
    private static final int MOST_LOOPS = 1_000_000;
    private static final int MOST_CORES = 64;
    private static final int MOST_REPETITIONS = 1000;
    private static final int REPETITIONS = 9;

    @Spec
    private CommandSpec spec;

    @Option(names = "--loops", paramLabel = "N", description = "how often each service loops in a measurement")
    private int loops = 1000;

    @Option(
            names = "--cores",
            paramLabel = "N",
            split = ",",
            description = "what the Java machines that measure are told to have")
    private List<Integer> cores = List.of(2, 3);

    @Option(names = "--modes", paramLabel = "MODE", split = ",", description = "of ${COMPLETION-CANDIDATES}")
    private List<Mode> modes = List.of(Mode.values());

    @Option(
            names = "--repetitions",
            paramLabel = "N",
            description = "of each measurement, from slightly different start poses; " + REPETITIONS
                    + " unless given, 1 in real time",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Integer repetitions;

    @Option(
            names = "--seconds",
            paramLabel = "N",
            description = "simulated time with changes of state, to count messages; in real time as long as the loops take")
    private double seconds = 300;

    @Option(names = "--reconnect", description = "measure as well what a change of state costs when services connect anew, as the paper's do")
    private boolean reconnect;

    @Option(
            names = "--realtime",
            description =
                    "by the clock on the wall, over TCP; 1000 loops then take a quarter of an hour for each number of cores, so think of --loops 100")
    private boolean realTime;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a .world or .cfg file with two robots; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private Path world = HOME.resolve(Path.of("demo", "worlds", "paper-arena.cfg"));

    @Option(names = "--out", paramLabel = "DIR", description = "where evaluation.csv and the pictures go")
    private Path out = Path.of("out");

    @Override
    public Integer call() throws IOException {
        var settings = settings();
        makeOutputDirectory();
        long begin = System.nanoTime();
        Measurements measurements;
        try (var progress = new EvaluationProgress(TerminalLine.open())) {
            measurements = new Evaluation(settings, progress).measure();
        }
        double tookSeconds = (System.nanoTime() - begin) / 1e9;
        Path csv = out.resolve("evaluation.csv");
        EvaluationCsv.write(measurements, csv);
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.print(new EvaluationReport(settings, measurements).text());
        terminal.printf(Locale.ROOT, "%ntook %.0f s, wrote %s%n", tookSeconds, csv);
        terminal.flush();
        return 0;
    }

    private EvaluationSettings settings() {
        check(loops >= 2 && loops <= MOST_LOOPS, "--loops is " + loops + ", expected a number from 2 to " + MOST_LOOPS);
        for (int count : cores) {
            check(count >= 1 && count <= MOST_CORES, "--cores is " + count + ", expected numbers from 1 to " + MOST_CORES);
        }
        int times = repetitions == null ? (realTime ? 1 : REPETITIONS) : repetitions;
        check(
                times >= 1 && times <= MOST_REPETITIONS,
                "--repetitions is " + times + ", expected a number from 1 to " + MOST_REPETITIONS);
        check(seconds > 0 && seconds <= 1e6, "--seconds is " + seconds + ", expected a number above 0 and up to 1000000");
        return new EvaluationSettings(
                world,
                loops,
                cores.stream().distinct().sorted().toList(),
                Arrays.stream(Mode.values()).filter(modes::contains).toList(),
                times,
                seconds,
                reconnect,
                realTime);
    }

    private void check(boolean fine, String complaint) {
        if (!fine) {
            throw new ParameterException(spec.commandLine(), complaint);
        }
    }

    private void makeOutputDirectory() {
        try {
            Files.createDirectories(out);
        } catch (IOException e) {
            throw new ParameterException(spec.commandLine(), "--out " + out + " cannot be made a directory: " + e);
        }
    }
}
