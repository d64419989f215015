package io.troupe.demo.verify;

import io.troupe.demo.table.ServiceJars;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.Pnml;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.bip.BipModel;
import io.troupe.services.component.application.ApplicationReader;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Arrays;
import java.util.Map;
import java.util.concurrent.Callable;
import java.util.function.Consumer;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/**
 * {@code troupe verify}: checks every statement of section 5 of the paper, examines a net from a file, or a BIP model.
 */
@Command(
        name = "verify",
        description =
                "Computes the paper's statements about its Petri nets, prints both side by side, and draws the nets.",
        footer = {
            "  troupe verify",
            "  troupe verify --net FILE.pnml",
            "  troupe verify --bip two-robots.app --out two-robots.bip"
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true,
        exitCodeListHeading = "Exit status:%n",
        exitCodeList = {
            "0:done; with --net: proved that no reachable marking is dead; with --bip: all that has to hold does",
            "1:failed; with --net: the net can deadlock, and nothing else; with --bip: something does not hold",
            "2:bad input: a wrong option, a file that cannot be read or written, a net with too many tokens",
            "3:with --net: not known within --time and --memory; with --bip likewise",
            "4:with --net: an error in this program, or its output could not be written; with --bip likewise",
            "130:interrupted; what was known until then was printed"
        },
        exitCodeOnExecutionException = 4)
public final class VerifyCommand implements Callable<Integer> {
    private static final int MAX_ROBOTS = 7;
    private static final double MAX_SECONDS = 1_000_000;

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--bip",
            arity = "0..1",
            fallbackValue = "",
            paramLabel = "FILE",
            description =
                    "instead: the BIP model of an application (an .app file), or of the paper's two robots if no file is"
                            + " given")
    private @Nullable Path bip;

    @Mixin
    private ServiceJars jars;

    @Option(
            names = "--out",
            paramLabel = "DIR",
            description =
                    "where verify.md, the nets and the drawings go; with --bip also one file: a .bip, .svg or .pnml")
    private Path out = Path.of("out");

    @Option(
            names = "--robots",
            paramLabel = "N",
            description = "how many robots the larger nets and wirings have, 1 to " + MAX_ROBOTS)
    private int robots = 6;

    @Option(names = "--net", paramLabel = "FILE", description = "examine this PNML file instead of the paper's nets")
    private @Nullable Path net;

    @Option(
            names = "--time",
            paramLabel = "SECONDS",
            description = "how long the searches of --net or --bip may take; then what is known is printed")
    private double seconds = 60;

    @Option(
            names = "--memory",
            paramLabel = "MIB",
            defaultValue = Option.NULL_VALUE,
            description = "how much memory the largest search of --net or --bip may take (default: 60 %% of the heap)")
    private @Nullable Integer memoryMib;

    @Override
    public Integer call() throws IOException {
        OptionRange.check(spec, "--robots", robots, 1, MAX_ROBOTS);
        if (!(seconds > 0 && seconds <= MAX_SECONDS)) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--time is " + seconds + ", expected seconds above 0, up to " + (int) MAX_SECONDS);
        }
        if (memoryMib != null && memoryMib < 1) {
            throw new ParameterException(spec.commandLine(), "--memory is " + memoryMib + ", expected MiB, 1 or more");
        }
        if (net != null && bip != null) {
            throw new ParameterException(spec.commandLine(), "--net and --bip are given, expected one of them");
        }
        if (net != null) {
            FileProblems.input(spec, net, "a net in PNML");
        }
        if (bip == null && net == null) {
            OutputDirectory.make(spec, out);
        }
        PrintWriter terminal = spec.commandLine().getOut();
        try (var interruption = Interruption.open();
                var line = ProgressLine.open()) {
            Consumer<String> progress = doing -> {
                interruption.check();
                line.show(doing);
            };
            Consumer<String> results = result -> line.interrupt(() -> {
                terminal.print(result);
                terminal.flush();
            });
            try {
                if (bip != null) {
                    return model(bip, interruption, line, results);
                }
                if (net != null) {
                    return examine(net, interruption, progress, results);
                }
                verifyPaper(progress, results);
            } catch (InterruptedCommand interrupted) {
                results.accept("\ninterrupted: what was known until then stands above; "
                        + (net == null ? "there is no new verify.md\n" : "nothing was drawn\n"));
                return Interruption.STATUS;
            }
        }
        return 0;
    }

    /** Prints each result as soon as it is known. */
    private void verifyPaper(Consumer<String> progress, Consumer<String> results) throws IOException {
        var readings = Arrays.stream(Reading.values())
                .map(reading -> ReadingStudy.of(reading, progress))
                .peek(study -> results.accept(VerifyReport.summary(study)))
                .toList();
        results.accept(VerifyReport.TEAMS_TITLE);
        var teams = IntStream.rangeClosed(1, robots)
                .mapToObj(count -> TeamStudy.of(count, progress))
                .peek(study -> results.accept(VerifyReport.summary(study)))
                .toList();
        results.accept(VerifyReport.WIRINGS_TITLE);
        var wirings = WiringStudy.all(robots, progress, study -> results.accept(VerifyReport.summary(study)));
        var files = new NetFiles(out);
        for (var reading : readings) {
            progress.accept("drawing the nets of reading " + reading.reading());
            files.write(reading);
        }
        OutputFiles.write(out.resolve("verify.md"), new VerifyReport(readings, teams, wirings).markdown());
        results.accept("wrote " + out.resolve("verify.md") + ", and the nets beside it as .pnml, .dot and .svg\n");
    }

    /** The values of an application file do not matter for its model. */
    private static final Map<String, String> VALUES = Map.of("host", "localhost", "port", "6665", "tcp", "6665");

    private int model(Path named, Interruption interruption, ProgressLine line, Consumer<String> results)
            throws IOException {
        boolean paper = named.toString().isEmpty();
        Path file = paper ? named : FileProblems.input(spec, named, "the file of a declaration");
        long end = System.nanoTime() + (long) (seconds * 1e9);
        var limits = SearchLimits.markings(Integer.MAX_VALUE)
                .cancelledBy(() -> {
                    interruption.check();
                    return System.nanoTime() - end > 0;
                })
                .reporting(10_000, found -> line.show("searching: " + found.markings() + " states"))
                .within(bytes());
        if (paper) {
            return new BipStudy(spec, out, limits, results).paper();
        }
        try (var opened = jars) {
            var plan = ApplicationReader.read(file, ComponentKinds.standard(opened.catalogue(file)), VALUES);
            BipModel model;
            try {
                model = ApplicationBip.of(plan);
            } catch (IllegalArgumentException e) {
                throw new ParameterException(spec.commandLine(), file + ": " + e.getMessage(), e);
            }
            return new BipStudy(spec, out, limits, results).application(plan, model);
        }
    }

    /** Errors after the verdict do not change the exit status, since scripts rely on it. */
    private int examine(Path file, Interruption interruption, Consumer<String> progress, Consumer<String> results) {
        PrintWriter err = spec.commandLine().getErr();
        try {
            var read = Pnml.read(file, warning -> {
                err.println("troupe: warning: " + warning);
                err.flush();
            });
            OutputDirectory.make(spec, out);
            var examination = new NetExamination(read, limits(interruption), progress, results);
            int status = examination.decide();
            try {
                examination.explain();
                examination.draw(
                        new NetFiles(out), file.getFileName().toString().replaceFirst("\\.[^.]*$", ""));
            } catch (InterruptedCommand interrupted) {
                throw interrupted;
            } catch (IOException e) {
                err.println("troupe: the pictures cannot be written: " + FileProblems.message(e));
            } catch (RuntimeException | OutOfMemoryError | StackOverflowError e) {
                err.println("troupe: after the verdict: " + e);
            }
            err.flush();
            return status;
        } catch (ArithmeticException e) {
            throw new ParameterException(spec.commandLine(), file + ": " + e.getMessage(), e);
        } catch (OutOfMemoryError e) {
            results.accept(file + ": not known: the virtual machine has too little memory for this net\n");
            return NetExamination.UNKNOWN;
        } catch (Error e) { // uncaught it would end the program with status 1, which is a verdict
            throw new IllegalStateException("an error in this program: " + e, e);
        }
    }

    private NetExamination.Limits limits(Interruption interruption) {
        var time = Duration.ofNanos((long) (seconds * 1e9));
        long start = System.nanoTime();
        Supplier<Duration> left = () -> {
            interruption.check(); // polled frequently, so that Ctrl-C does not wait for the time limit
            return time.minusNanos(System.nanoTime() - start);
        };
        return new NetExamination.Limits(time, left, bytes());
    }

    private long bytes() {
        return memoryMib == null ? Runtime.getRuntime().maxMemory() / 5 * 3 : (long) memoryMib << 20;
    }
}
