package io.troupe.demo;

import io.troupe.player.PlayerException;
import io.troupe.sim.scenario.WorldFileException;
import java.io.PrintWriter;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.ParameterException;

/** The command line {@code troupe}; without a command it does {@code run}. */
@Command(
        name = "troupe",
        description = "Typed actors and promises on one thread, for robots.",
        mixinStandardHelpOptions = true,
        version = "Troupe 0.1.0-SNAPSHOT",
        subcommands = RunCommand.class)
public final class Main {
    /** Exit status for a wrong option, file or number. */
    static final int USAGE = 2;

    private Main() {}

    public static void main(String[] arguments) {
        var out = new PrintWriter(System.out, true);
        var err = new PrintWriter(System.err, true);
        System.exit(execute(out, err, arguments.length == 0 ? new String[] {"run"} : arguments));
    }

    /** Runs a command and answers its exit status: 0 done, 1 failed, 2 used wrongly. */
    static int execute(PrintWriter out, PrintWriter err, String... arguments) {
        return new CommandLine(new Main())
                .setOut(out)
                .setErr(err)
                .setParameterExceptionHandler((wrong, given) -> complain(wrong.getCommandLine(), oneLine(wrong)))
                .setExecutionExceptionHandler((thrown, commandLine, parsed) -> {
                    if (thrown instanceof WorldFileException || thrown instanceof PlayerException) {
                        return complain(commandLine, thrown.getMessage());
                    }
                    throw thrown;
                })
                .execute(arguments);
    }

    private static int complain(CommandLine commandLine, String problem) {
        PrintWriter err = commandLine.getErr();
        err.println(
                "troupe: " + problem + " (see " + commandLine.getCommandSpec().qualifiedName() + " --help)");
        err.flush();
        return USAGE;
    }

    private static String oneLine(ParameterException wrong) {
        return wrong.getMessage().lines().findFirst().orElse("wrong arguments");
    }
}
