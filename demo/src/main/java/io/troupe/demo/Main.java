package io.troupe.demo;

import io.troupe.demo.app.AppCommand;
import io.troupe.demo.crowd.CrowdCommand;
import io.troupe.demo.draw.DrawCommand;
import io.troupe.demo.evaluate.EvaluateCommand;
import io.troupe.demo.serve.ReplayCommand;
import io.troupe.demo.serve.ServeCommand;
import io.troupe.demo.table.TableCommand;
import io.troupe.demo.verify.VerifyCommand;
import io.troupe.petri.PnmlException;
import io.troupe.player.PlayerException;
import io.troupe.services.broker.MissingServiceException;
import io.troupe.services.component.application.ApplicationException;
import io.troupe.services.component.application.ApplicationFileException;
import io.troupe.services.subsumption.ServiceJarException;
import io.troupe.services.subsumption.SubsumptionTableException;
import io.troupe.sim.RecordingException;
import io.troupe.sim.scenario.WorldFileException;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.nio.file.FileSystemException;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.stream.Stream;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.ParameterException;

/** The command line {@code troupe}; without a command it does {@code run}. */
@Command(
        name = "troupe",
        description = "Typed actors and promises on one thread, for robots.",
        mixinStandardHelpOptions = true,
        version = "Troupe 0.1.0-SNAPSHOT",
        scope = CommandLine.ScopeType.INHERIT,
        subcommands = {
            RunCommand.class,
            ModesCommand.class,
            EvaluateCommand.class,
            CrowdCommand.class,
            TableCommand.class,
            AppCommand.class,
            VerifyCommand.class,
            ServeCommand.class,
            ReplayCommand.class,
            DrawCommand.class
        })
public final class Main {
    /** Exit status for a wrong option, file or number. */
    static final int USAGE = 2;
    /** Exit status for what went wrong on the way: a file that cannot be written, a server that goes away. */
    static final int FAILED = 1;

    /** Exit status for a service that an application needs and nobody offers. */
    static final int MISSING_SERVICE = 3;

    private Main() {}

    public static void main(String[] arguments) {
        var out = new PrintWriter(System.out, true);
        var err = new PrintWriter(System.err, true);
        System.exit(execute(out, err, arguments));
    }

    /** Runs a command and answers its exit status: 0 done, 1 failed, 2 used wrongly, 3 a service is missing. */
    static int execute(PrintWriter out, PrintWriter err, String... arguments) {
        return new CommandLine(new Main())
                .setOut(out)
                .setErr(err)
                .setCaseInsensitiveEnumValuesAllowed(true)
                .setParameterExceptionHandler((wrong, given) -> complain(wrong.getCommandLine(), oneLine(wrong)))
                .setExecutionExceptionHandler((thrown, commandLine, parsed) -> {
                    if (thrown instanceof WorldFileException
                            || thrown instanceof PnmlException
                            || thrown instanceof SubsumptionTableException
                            || thrown instanceof ServiceJarException
                            || thrown instanceof ApplicationFileException) {
                        return complain(commandLine, thrown.getMessage());
                    }
                    if (thrown instanceof MissingServiceException) {
                        return tell(err, thrown, MISSING_SERVICE);
                    }
                    if (thrown instanceof IOException
                            || thrown instanceof UncheckedIOException
                            || thrown instanceof RecordingException
                            || thrown instanceof ApplicationException
                            || thrown instanceof PlayerException) {
                        return tell(err, thrown, FAILED);
                    }
                    throw thrown;
                })
                .execute(withCommand(arguments));
    }

    private static int tell(PrintWriter err, Exception thrown, int status) {
        err.println("troupe: " + failure(thrown));
        err.flush();
        return status;
    }

    /** {@code run} is what is done unless something else is asked for. */
    private static String[] withCommand(String[] arguments) {
        boolean optionsOfRun = arguments.length == 0
                || arguments[0].startsWith("--")
                        && !List.of("--help", "--version").contains(arguments[0]);
        return optionsOfRun
                ? Stream.concat(Stream.of("run"), Arrays.stream(arguments)).toArray(String[]::new)
                : arguments;
    }

    private static int complain(CommandLine commandLine, String problem) {
        PrintWriter err = commandLine.getErr();
        err.println(
                "troupe: " + problem + " (see " + commandLine.getCommandSpec().qualifiedName() + " --help)");
        err.flush();
        return USAGE;
    }

    /** What went wrong without the names of classes, except where a file's name is all that the message says. */
    private static String failure(Exception thrown) {
        if (thrown instanceof UncheckedIOException && thrown.getCause() instanceof FileSystemException cause) {
            return failure(cause);
        }
        if (thrown instanceof FileSystemException file && file.getReason() == null) {
            String kind = file.getClass().getSimpleName().replace("Exception", "");
            return file.getFile() + ": "
                    + kind.replaceAll("(?<=[a-z])(?=[A-Z])", " ").toLowerCase(Locale.ROOT);
        }
        String message = thrown.getMessage();
        return message == null ? thrown.toString() : message;
    }

    private static String oneLine(ParameterException wrong) {
        return wrong.getMessage().lines().findFirst().orElse("wrong arguments");
    }
}
