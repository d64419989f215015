package io.troupe.demo.evaluate;

import io.troupe.common.text.Plural;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.services.subsumption.Mode;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe evaluate}: measures Figures 15, 18, 21, 22 and 23 of the paper again. */
@Command(
        name = "evaluate",
        description =
                "Measures what section 4 of the paper measured, and sets the paper's values beside what comes out.",
        footer = {
            "  troupe evaluate",
            "  troupe evaluate --loops 1000 --reconnect",
            "  troupe evaluate --realtime --loops 100 --cores 1"
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class EvaluateCommand implements Callable<Integer> {
    private static final int MOST_LOOPS = 1_000_000;
    private static final int MOST_CORES = 64;
    private static final int MOST_REPETITIONS = 1000;
    private static final int REPETITIONS = 15;
    private static final int MOST_SECONDS = 1_000_000;
    private static final int SECONDS = 300;
    private static final int REAL_SECONDS = 60;
    private static final int MOST_WARM_UPS = 100;

    @Spec
    private CommandSpec spec;

    @Option(names = "--loops", paramLabel = "N", description = "how often each service loops in a measurement")
    private int loops = 1000;

    @Option(
            names = "--cores",
            paramLabel = "N",
            split = ",",
            description = "the processors of the Java machines that measure")
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
            names = "--warm-up",
            paramLabel = "N",
            description = "how often everything is done before it is measured, so that Java has compiled it")
    private int warmUps = 3;

    @Option(
            names = "--seconds",
            paramLabel = "N",
            description = "how long robots change states, to count messages; " + SECONDS + " s unless given, "
                    + REAL_SECONDS + " in real time",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Double seconds;

    @Option(
            names = "--reconnect",
            description = "measure as well what a change of state costs when services connect anew, as the paper's do")
    private boolean reconnect;

    @Option(
            names = "--realtime",
            description =
                    "by the clock on the wall, over TCP; with --loops 100 and one of --cores that takes 4 minutes, with 1000 loops 13")
    private boolean realTime;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a .world or .cfg file with two robots; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private Path world = Installation.world("paper-arena.cfg");

    @Mixin
    private WorldLoader loader;

    @Option(names = "--out", paramLabel = "DIR", description = "where evaluation.csv and the pictures go")
    private Path out = Path.of("out");

    @Override
    public Integer call() throws IOException {
        System.setProperty("java.awt.headless", "true"); // drawing needs no display
        world = FileProblems.input(spec, world, "a world file");
        var settings = settings();
        var paperWorld = PaperWorld.of(loader.read(world), world);
        prepare(settings.log());
        long begin = System.nanoTime();
        try (var interruption = Interruption.open()) {
            Evaluation.Outcome outcome;
            try (var progress = new EvaluationProgress(ProgressLine.open())) {
                outcome = new Evaluation(settings, paperWorld, progress, interruption).run();
            }
            double tookSeconds = (System.nanoTime() - begin) / 1e9;
            return interruption.isRequested() ? interrupted(settings, outcome) : report(outcome, tookSeconds);
        }
    }

    /** Reports what was measured before the interruption. */
    private int interrupted(Evaluation.Settings settings, Evaluation.Outcome outcome) throws IOException {
        PrintWriter terminal = spec.commandLine().getOut();
        int complete = outcome.settings().repetitions();
        if (complete > 0) {
            terminal.print(new EvaluationReport(outcome).text());
        }
        terminal.printf(
                "%ninterrupted: %d of %s complete%n",
                complete,
                Plural.of(settings.repetitions(), "repetition") + (settings.repetitions() == 1 ? " was" : " were"));
        terminal.flush();
        if (Files.size(settings.log()) == 0) {
            Files.delete(settings.log());
        }
        if (!outcome.all().all().isEmpty()) {
            Path csv = out.resolve("evaluation.csv");
            outcome.all().writeCsv(csv);
            terminal.println("wrote " + Plural.of(outcome.all().all().size(), "number") + ", all that was measured, to "
                    + csv + "; there are no new pictures");
        }
        terminal.flush();
        return Interruption.STATUS;
    }

    private int report(Evaluation.Outcome outcome, double tookSeconds) throws IOException {
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.print(new EvaluationReport(outcome).text()); // before writing files, which may fail
        terminal.flush();
        Path log = outcome.settings().log();
        if (Files.size(log) == 0) {
            Files.delete(log);
        } else {
            terminal.println("\nwhat was logged meanwhile is in " + log);
        }
        Path csv = out.resolve("evaluation.csv");
        outcome.all().writeCsv(csv);
        terminal.printf(Locale.ROOT, "%ntook %.0f s, wrote %s%n", tookSeconds, csv);
        terminal.flush();
        var names = new EvaluationFigures(outcome.settings(), outcome.measurements()).write(out);
        terminal.println("and, as .svg and .png: "
                + names.stream().map(name -> out.resolve(name).toString()).collect(Collectors.joining(", ")));
        terminal.flush();
        return 0;
    }

    private Evaluation.Settings settings() {
        OptionRange.check(spec, "--loops", loops, 2, MOST_LOOPS);
        for (int count : cores) {
            if (count < 1 || count > MOST_CORES) {
                throw new ParameterException(
                        spec.commandLine(), "--cores is " + count + ", expected numbers from 1 to " + MOST_CORES);
            }
        }
        int times = repetitions == null ? (realTime ? 1 : REPETITIONS) : repetitions;
        OptionRange.check(spec, "--repetitions", times, 1, MOST_REPETITIONS);
        OptionRange.check(spec, "--warm-up", warmUps, 0, MOST_WARM_UPS);
        double changing = seconds == null ? (realTime ? REAL_SECONDS : SECONDS) : seconds;
        OptionRange.checkSeconds(spec, changing, MOST_SECONDS);
        return new Evaluation.Settings(
                world,
                loops,
                cores.stream().distinct().sorted().toList(),
                Arrays.stream(Mode.values()).filter(modes::contains).toList(),
                times,
                warmUps,
                changing,
                reconnect,
                realTime,
                out.resolve("evaluation.log"));
    }

    /** Creates the output directory and the log before the measurement, so that errors appear early. */
    private void prepare(Path log) {
        OutputDirectory.make(spec, out);
        try {
            Files.write(log, new byte[0]);
        } catch (IOException e) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--out " + out + " is no directory that can be written to: " + FileProblems.message(log, e));
        }
    }
}
