package io.troupe.demo.verify;

import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.TerminalLine;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.Pnml;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.concurrent.Callable;
import java.util.function.Consumer;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe verify}: every statement of the paper's fifth section, with our result beside it. */
@Command(
        name = "verify",
        description =
                "Computes what the paper says about its Petri nets, prints both side by side, and draws the nets.",
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class VerifyCommand implements Callable<Integer> {
    private static final int MAX_ROBOTS = 7;

    @Spec
    private CommandSpec spec;

    @Option(names = "--out", paramLabel = "DIR", description = "where verify.md, the nets and the drawings go")
    private Path out = Path.of("out");

    @Option(
            names = "--robots",
            paramLabel = "N",
            description = "how many robots the larger nets and wirings have, 1 to " + MAX_ROBOTS)
    private int robots = 6;

    @Option(names = "--net", paramLabel = "FILE", description = "examine this PNML file instead of the paper's nets")
    private @Nullable Path net;

    @Override
    public Integer call() throws IOException {
        if (robots < 1 || robots > MAX_ROBOTS) {
            throw new ParameterException(
                    spec.commandLine(), "--robots is " + robots + ", expected a number from 1 to " + MAX_ROBOTS);
        }
        OutputDirectory.make(spec, out);
        PrintWriter terminal = spec.commandLine().getOut();
        try (var interruption = Interruption.open();
                var line = TerminalLine.open()) {
            Consumer<String> progress = doing -> {
                interruption.check();
                line.show(doing);
            };
            Consumer<String> results = result -> line.interrupt(() -> {
                terminal.print(result);
                terminal.flush();
            });
            try {
                if (net == null) {
                    verifyPaper(progress, results);
                } else {
                    results.accept(examine(net, progress));
                }
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
        results.accept(
                "wrote " + out.resolve("verify.md") + ", and the nets beside it as .pnml, .dot and .svg\n");
    }

    private String examine(Path file, Consumer<String> progress) throws IOException {
        FileProblems.checkInput(spec, file, "a net in PNML");
        OwnNet own;
        try {
            own = OwnNet.of(Pnml.read(file), progress);
        } catch (ArithmeticException e) {
            throw new ParameterException(spec.commandLine(), file + ": " + e.getMessage(), e);
        }
        var name = file.getFileName().toString().replaceFirst("\\.[^.]*$", "");
        var written = own.write(new NetFiles(out), name);
        return own.summary() + "wrote, as .dot and .svg: "
                + written.stream().map(each -> out.resolve(each).toString()).collect(Collectors.joining(", ")) + "\n";
    }
}
