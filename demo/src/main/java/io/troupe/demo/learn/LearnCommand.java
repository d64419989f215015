package io.troupe.demo.learn;

import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Spec;

/** {@code troupe learn}: the commands that step worlds without server and clients. */
@Command(
        name = "learn",
        description = "Steps worlds as a library does, without server and clients: examples, and a process for Python.",
        mixinStandardHelpOptions = true,
        subcommands = {TuneCommand.class, CornersCommand.class, ServeTrialsCommand.class})
public final class LearnCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    /** Without a subcommand: prints the usage. */
    @Override
    public Integer call() {
        spec.commandLine().usage(spec.commandLine().getOut());
        spec.commandLine().getOut().flush();
        return 0;
    }
}
