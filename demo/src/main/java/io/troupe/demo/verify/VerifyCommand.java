package io.troupe.demo.verify;

import io.troupe.demo.terminal.TerminalLine;
import io.troupe.petri.PaperNets.Reading;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.concurrent.Callable;
import java.util.stream.IntStream;
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
    private static final int MAX_ROBOTS = 8;

    @Spec
    private CommandSpec spec;

    @Option(names = "--out", paramLabel = "DIR", description = "where verify.md, the nets and the drawings go")
    private Path out = Path.of("out");

    @Option(
            names = "--robots",
            paramLabel = "N",
            description = "up to how many robots the paper's nets are searched for dead markings")
    private int robots = 6;

    @Override
    public Integer call() throws IOException {
        if (robots < 1 || robots > MAX_ROBOTS) {
            throw new ParameterException(
                    spec.commandLine(), "--robots is " + robots + ", expected a number from 1 to " + MAX_ROBOTS);
        }
        try {
            Files.createDirectories(out);
        } catch (IOException e) {
            throw new ParameterException(spec.commandLine(), "--out " + out + " cannot be made a directory: " + e);
        }
        PrintWriter terminal = spec.commandLine().getOut();
        VerifyReport report;
        try (var line = TerminalLine.open()) {
            var readings = Arrays.stream(Reading.values())
                    .map(reading -> ReadingStudy.of(reading, line::show))
                    .toList();
            var teams = IntStream.rangeClosed(1, robots)
                    .mapToObj(count -> TeamStudy.of(count, line::show))
                    .toList();
            report = new VerifyReport(readings, teams, WiringStudy.all(line::show));
        }
        Files.writeString(out.resolve("verify.md"), report.markdown());
        terminal.print(report.summary());
        terminal.println("wrote " + out.resolve("verify.md"));
        terminal.flush();
        return 0;
    }
}
