package io.troupe.actor.soak;

import java.util.concurrent.Callable;
import java.util.function.Function;
import java.util.regex.Pattern;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;
import picocli.CommandLine.TypeConversionException;

/**
 * The command line of the soak test. Its exit status is 0; 1 if a message was lost, out of order or retained; or 2 for
 * invalid arguments.
 */
@Command(
        name = "soak",
        description = "Sends messages from several threads to actors, half of them with bounded mailboxes.",
        showDefaultValues = true)
public final class SoakMain implements Callable<Integer> {
    private static final int FAULTS_PRINTED = 20;
    /** What picocli puts before the message of a converter. */
    private static final Pattern INVALID_VALUE =
            Pattern.compile("^Invalid value for option '([^']*)'(?: \\([^)]*\\))?: ");

    @Spec
    private CommandSpec spec;

    @Option(names = "--messages", paramLabel = "N", description = "the total over both mailboxes and both sinks")
    private long messages = SoakOptions.DEFAULT.messages();

    @Option(names = "--producers", paramLabel = "N", description = "the number of sending threads")
    private int producers = SoakOptions.DEFAULT.producers();

    @Option(
            names = "--window",
            paramLabel = "N",
            description = "messages of one producer to one sink between two requests")
    private int window = SoakOptions.DEFAULT.window();

    @Option(names = "--capacity", paramLabel = "N", description = "of the bounded mailbox")
    private int capacity = SoakOptions.DEFAULT.capacity();

    @Option(
            names = "--heap-bound-mib",
            paramLabel = "N",
            description = "allowed increase of the heap in use after a collection, since the beginning")
    private int heapBoundMib = SoakOptions.DEFAULT.heapBoundMib();

    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "prints the options")
    private boolean help;

    private SoakMain() {}

    public static void main(String[] arguments) {
        System.exit(commandLine().execute(arguments));
    }

    /** @throws ParameterException if an option or its value is wrong */
    static SoakOptions options(String... arguments) {
        var commandLine = commandLine();
        commandLine.parseArgs(arguments);
        return commandLine.<SoakMain>getCommand().options();
    }

    static CommandLine commandLine() {
        ITypeConverter<Long> longs = text -> whole(text, Long::valueOf);
        ITypeConverter<Integer> integers = text -> whole(text, Integer::valueOf);
        return new CommandLine(new SoakMain())
                .setOverwrittenOptionsAllowed(true)
                .registerConverter(long.class, longs)
                .registerConverter(int.class, integers)
                .setParameterExceptionHandler((wrong, arguments) -> {
                    CommandLine command = wrong.getCommandLine();
                    command.getErr()
                            .println("soak: "
                                    + INVALID_VALUE.matcher(wrong.getMessage()).replaceFirst("$1 is "));
                    command.usage(command.getErr());
                    return CommandLine.ExitCode.USAGE;
                });
    }

    /** Numbers may have underscores, as in Java. */
    private static <T> T whole(String text, Function<String, T> parse) {
        try {
            return parse.apply(text.replace("_", ""));
        } catch (NumberFormatException notOne) {
            throw new TypeConversionException(text + ", expected a whole number");
        }
    }

    private SoakOptions options() {
        try {
            return new SoakOptions(messages, producers, window, capacity, heapBoundMib);
        } catch (IllegalArgumentException wrong) {
            throw new ParameterException(spec.commandLine(), wrong.getMessage(), wrong);
        }
    }

    @Override
    public Integer call() throws InterruptedException {
        SoakOptions options = options();
        System.out.println("soak: " + options);
        var faults = new Soak(options, System.out::println).run();
        faults.stream().limit(FAULTS_PRINTED).forEach(fault -> System.out.println("VIOLATION " + fault));
        System.out.println(
                faults.isEmpty()
                        ? "soak: nothing lost, nothing out of order, memory flat"
                        : "soak: " + faults.size() + " violation(s)");
        return faults.isEmpty() ? 0 : 1;
    }
}
