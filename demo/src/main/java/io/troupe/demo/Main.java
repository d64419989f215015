package io.troupe.demo;

import io.troupe.broker.MissingServiceException;
import io.troupe.bus.BusException;
import io.troupe.common.text.SourceException;
import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.Suggestions;
import io.troupe.demo.app.AppCommand;
import io.troupe.demo.crowd.CrowdCommand;
import io.troupe.demo.evaluate.EvaluateCommand;
import io.troupe.demo.hosts.OfferCommand;
import io.troupe.demo.hosts.ServicesCommand;
import io.troupe.demo.learn.LearnCommand;
import io.troupe.demo.monitor.AppMonitor;
import io.troupe.demo.serve.ReplayCommand;
import io.troupe.demo.serve.ServeCommand;
import io.troupe.demo.table.TableCommand;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.verify.VerifyCommand;
import io.troupe.petri.PnmlException;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.player.PlayerException;
import io.troupe.services.component.application.ApplicationException;
import io.troupe.services.component.application.ApplicationFileException;
import io.troupe.services.subsumption.ServiceJarException;
import io.troupe.sim.RecordingException;
import io.troupe.sim.worldfile.WorldFileException;
import io.troupe.view.RunLog;
import io.troupe.view.tools.RunFileException;
import java.io.BufferedOutputStream;
import java.io.FileDescriptor;
import java.io.FileOutputStream;
import java.io.FilterOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.io.PrintStream;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.Callable;
import java.util.function.Function;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.HelpCommand;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.MissingParameterException;
import picocli.CommandLine.Model.ArgSpec;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.MutuallyExclusiveArgsException;
import picocli.CommandLine.OverwrittenOptionException;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;
import picocli.CommandLine.TypeConversionException;
import picocli.CommandLine.UnmatchedArgumentException;

/** The command line {@code troupe}. */
@Command(
        name = "troupe",
        description = "Typed actors and promises on one thread, for robots.",
        mixinStandardHelpOptions = true,
        version = RunLog.PROGRAM,
        scope = CommandLine.ScopeType.INHERIT,
        subcommands = {
            RunCommand.class,
            ModesCommand.class,
            EvaluateCommand.class,
            CrowdCommand.class,
            LearnCommand.class,
            TableCommand.class,
            AppCommand.class,
            VerifyCommand.class,
            ServeCommand.class,
            OfferCommand.class,
            ReplayCommand.class,
            ExportCommand.class,
            ServicesCommand.class,
            HostsCommand.class,
            DrawCommand.class,
            NewCommand.class,
            HelpCommand.class
        })
public final class Main implements Callable<Integer> {
    private static final int EXCERPT_COLUMNS = 100;
    private static final String EXCERPT_INDENT = "    ";

    /** Exit status for a wrong option, file or number. */
    static final int USAGE = 2;
    /** Exit status for a failure during execution: a file that cannot be written, a lost server connection. */
    static final int FAILED = 1;

    private static final int ERROR_BESIDE_VERDICT = 4;

    /** Exit status if an application needs a service that no provider offers. */
    static final int MISSING_SERVICE = 3;

    @Spec
    private CommandSpec spec;

    private Main() {}

    /** Without a subcommand: prints the usage. */
    @Override
    public Integer call() {
        PrintWriter out = spec.commandLine().getOut();
        spec.commandLine().usage(out);
        out.flush();
        return 0;
    }

    public static void main(String[] arguments) {
        var standardOutput = new StandardOutput(new FileOutputStream(FileDescriptor.out));
        // the same stream and charset, but write errors are recorded
        System.setOut(new PrintStream(new BufferedOutputStream(standardOutput), true, System.out.charset()));
        var out = new PrintWriter(System.out, true);
        var err = new PrintWriter(System.err, true);
        int status = execute(out, err, arguments);
        out.flush();
        String lost = standardOutput.lost();
        if (lost != null) {
            err.println("troupe: the output could not be written: " + lost);
            status = status != 0 ? status : hasVerdict(arguments) ? ERROR_BESIDE_VERDICT : FAILED;
        }
        System.exit(status);
    }

    /** True for {@code verify --net} and {@code verify --bip}, where exit status 1 is a verdict. */
    private static boolean hasVerdict(String... arguments) {
        return Arrays.stream(arguments).anyMatch(each -> each.matches("--(net|bip)(=.*)?"));
    }

    /** Runs a command and returns its exit status, one of {@link #exitStatuses}. */
    static int execute(PrintWriter out, PrintWriter err, String... arguments) {
        return commandLine(out, err).execute(withCommand(arguments));
    }

    /** All commands and their options. */
    static CommandLine commandLine(PrintWriter out, PrintWriter err) {
        var troupe = new CommandLine(new Main());
        troupe.getCommandSpec()
                .usageMessage() // not in the annotation, since subcommands would inherit it
                .exitCodeListHeading("%nExit status:%n")
                .exitCodeList(exitStatuses())
                .footer("", "Start with the main job: troupe run", "Options of a command: troupe help COMMAND");
        HelpPage.layOut(troupe, HelpPage.columns(System.getenv("COLUMNS"), System.getProperty("troupe.columns")));
        return Converters.register(troupe)
                .setOut(out)
                .setErr(err)
                .setCaseInsensitiveEnumValuesAllowed(true)
                .setParameterExceptionHandler(
                        (wrong, given) -> reportUsage(wrong.getCommandLine(), UsageProblems.message(wrong)))
                .setExecutionExceptionHandler((thrown, commandLine, parsed) -> {
                    if (thrown instanceof SourceException
                            || thrown instanceof PnmlException
                            || thrown instanceof ServiceJarException) {
                        boolean isWholeFile = thrown instanceof SourceException source
                                && source.where().isEmpty();
                        return isWholeFile ? reportUsage(commandLine, thrown.getMessage()) : reportMistake(err, thrown);
                    }
                    if (thrown instanceof MissingServiceException) {
                        return reportFailure(err, thrown, MISSING_SERVICE);
                    }
                    if (thrown instanceof IOException
                            || thrown instanceof UncheckedIOException
                            || thrown instanceof RecordingException
                            || thrown instanceof ApplicationException
                            || thrown instanceof BusException
                            || thrown instanceof PlayerException
                            || thrown instanceof WiringMonitor.ViolationException
                            || thrown instanceof AppMonitor.MonitorException) {
                        return reportFailure(err, thrown, FAILED);
                    }
                    throw thrown;
                });
    }

    private static Map<String, String> exitStatuses() {
        Map<String, String> statuses = new LinkedHashMap<>();
        statuses.put("0", "done");
        statuses.put("" + FAILED, "failed on the way");
        statuses.put(
                "" + USAGE,
                "used wrongly: an option, a number, a file that cannot be read, or an output that cannot be written");
        statuses.put("" + MISSING_SERVICE, "a service is missing (app, run --bus)");
        statuses.put("" + Interruption.STATUS, "interrupted; what was done until then was printed");
        return statuses;
    }

    private static int reportFailure(PrintWriter err, Exception thrown, int status) {
        err.println("troupe: " + failure(thrown));
        err.flush();
        return status;
    }

    /** Inserts {@code run} before options that have no command. */
    static String[] withCommand(String[] arguments) {
        boolean optionsOfRun = arguments.length > 0
                && arguments[0].startsWith("--")
                && !List.of("--help", "--version").contains(arguments[0]);
        return optionsOfRun
                ? Stream.concat(Stream.of("run"), Arrays.stream(arguments)).toArray(String[]::new)
                : arguments;
    }

    private static int reportUsage(CommandLine commandLine, String problem) {
        PrintWriter err = commandLine.getErr();
        err.println(
                "troupe: " + problem + " (see " + commandLine.getCommandSpec().qualifiedName() + " --help)");
        err.flush();
        return USAGE;
    }

    /** A mistake in a file: the message with the page about such files, then the line with a mark at the place. */
    private static int reportMistake(PrintWriter err, Exception mistake) {
        String page = switch (mistake) {
            case WorldFileException world -> "05-worlds";
            case ApplicationFileException application -> "09-components";
            case RunFileException run -> "16-recordings-in-other-tools";
            case PnmlException net -> "03-proving-a-wiring";
            default -> "06-subsumption"; // tables, and jars with services
        };
        err.println("troupe: " + mistake.getMessage() + " (see docs/guide/" + page + ".md)");
        if (mistake instanceof SourceException source) {
            source.where().flatMap(Main::excerpt).ifPresent(err::println);
        }
        err.flush();
        return USAGE;
    }

    /** The line of a position, with a mark below the column; empty if the file can no longer be read. */
    private static Optional<String> excerpt(SourcePosition where) {
        try (Stream<String> lines = Files.lines(where.file())) {
            return lines.skip(where.line() - 1L).findFirst().map(line -> {
                int column = Math.min(where.column() - 1, line.length());
                int from = Math.max(0, column - EXCERPT_COLUMNS / 2);
                String shown = line.substring(from, Math.min(line.length(), from + EXCERPT_COLUMNS));
                String before = shown.substring(0, column - from).replaceAll("[^\\t]", " ");
                return EXCERPT_INDENT + shown + System.lineSeparator() + EXCERPT_INDENT + before + "^";
            });
        } catch (IOException | UncheckedIOException unreadable) { // the message has the position
            return Optional.empty();
        }
    }

    /** The error message without class names. */
    private static String failure(Exception thrown) {
        if (thrown instanceof UncheckedIOException unchecked
                && unchecked.getCause() instanceof FileSystemException cause) {
            return FileProblems.message(cause);
        }
        if (thrown instanceof IOException problem) {
            return FileProblems.message(problem);
        }
        String message = thrown.getMessage();
        return message == null ? thrown.toString() : message;
    }

    /** picocli converters for numbers and paths, with plain error messages. */
    private static final class Converters {
        private Converters() {}

        static CommandLine register(CommandLine commandLine) {
            ITypeConverter<Integer> integers = number(Integer::valueOf, "a whole number");
            ITypeConverter<Long> longs = number(Long::valueOf, "a whole number");
            ITypeConverter<Double> doubles = number(Double::valueOf, "a number");
            return commandLine
                    .registerConverter(int.class, integers)
                    .registerConverter(Integer.class, integers)
                    .registerConverter(long.class, longs)
                    .registerConverter(Long.class, longs)
                    .registerConverter(double.class, doubles)
                    .registerConverter(Double.class, doubles)
                    .registerConverter(Path.class, Converters::path);
        }

        private static <T> ITypeConverter<T> number(Function<String, T> parse, String expected) {
            return text -> {
                try {
                    return parse.apply(text);
                } catch (NumberFormatException e) {
                    throw new TypeConversionException("'" + text + "', expected " + expected);
                }
            };
        }

        private static Path path(String text) {
            try {
                return Path.of(text);
            } catch (InvalidPathException e) {
                String encoding = System.getProperty("sun.jnu.encoding", "unknown");
                throw new TypeConversionException("'" + text + "' can be no file here, where names are in " + encoding
                        + "; in another locale, such as LC_ALL=C.UTF-8, it may");
            }
        }
    }

    /**
     * Error messages for wrong arguments: one line that names the option, its value and what was expected, with a
     * suggestion for a misspelled name.
     */
    private static final class UsageProblems {
        private static final String ERROR = "Error: ";
        /** Message of picocli's help command. */
        private static final Pattern UNKNOWN_COMMAND = Pattern.compile("Unknown subcommand '(.*)'\\.?");

        private static final Pattern EXCLUSIVE = Pattern.compile("Error: (.*) are mutually exclusive .*");

        private UsageProblems() {}

        static String message(ParameterException wrong) {
            String line = wrong.getMessage().lines().findFirst().orElse("wrong arguments");
            ArgSpec argument = wrong.getArgSpec();
            var unknown = UNKNOWN_COMMAND.matcher(line);
            var exclusive = EXCLUSIVE.matcher(line);
            return switch (wrong) {
                case UnmatchedArgumentException unmatched ->
                    unmatched(unmatched.getUnmatched(), wrong.getCommandLine());
                case MissingParameterException missing -> missing(line, missing.getMissing());
                case OverwrittenOptionException twice ->
                    name(twice.getOverwritten()) + " is given twice, expected once";
                case MutuallyExclusiveArgsException both
                when exclusive.matches() ->
                    exclusive.group(1).replaceFirst(",(?=[^,]*$)", " and") + " are given, expected one of them";
                default ->
                    unknown.matches()
                            ? unmatched(List.of(unknown.group(1)), wrong.getCommandLine())
                            : argument != null && wrong.getValue() != null
                                    ? value(line, argument, wrong.getValue())
                                    : line.startsWith(ERROR) ? line.substring(ERROR.length()) : line;
            };
        }

        private static String missing(String line, List<ArgSpec> missing) {
            String names = missing.stream().map(UsageProblems::name).collect(Collectors.joining(" and "));
            ArgSpec first = missing.getFirst();
            boolean isValue = first.isOption() && !line.startsWith("Missing required option");
            return isValue
                    ? names + " is given without its value, expected " + names + " " + first.paramLabel()
                    : names + (missing.size() == 1 ? " is missing, expected " + expected(first) : " are missing");
        }

        private static String expected(ArgSpec argument) {
            String[] description = argument.description();
            return description.length == 0 ? argument.paramLabel() : description[0];
        }

        private static String name(ArgSpec argument) {
            return argument instanceof OptionSpec option ? option.longestName() : argument.paramLabel();
        }

        /** A value that is none of its type. */
        private static String value(String line, ArgSpec argument, String value) {
            Class<?> type = argument.auxiliaryTypes().length == 0 ? argument.type() : argument.auxiliaryTypes()[0];
            String is = name(argument) + " is ";
            Object[] constants = type.getEnumConstants();
            if (constants != null) {
                List<String> names = Arrays.stream(constants)
                        .map(each -> each.toString().toLowerCase(Locale.ROOT))
                        .toList();
                return is + "'" + value + "'" + Suggestions.expected("one of", value, names);
            }
            if (type == boolean.class) {
                return is + "'" + value + "', expected no value, true or false";
            }
            return is + line.replaceFirst("^Invalid value for [^:]*: ", "");
        }

        private static String unmatched(List<String> arguments, CommandLine commandLine) {
            String first = arguments.getFirst();
            CommandSpec spec = commandLine.getCommandSpec();
            if (first.startsWith("-")) {
                String option = first.replaceFirst("=.*", "");
                List<String> known = spec.optionsMap().keySet().stream()
                        .filter(each -> each.startsWith("--"))
                        .toList();
                return "there is no option " + option + Suggestions.clauseForArgument(option, known);
            }
            return spec.subcommands().isEmpty()
                    ? "'" + first + "' is one argument too many"
                    : "there is no command '" + first + "'"
                            + Suggestions.clauseForArgument(
                                    first, spec.subcommands().keySet());
        }
    }

    /**
     * Standard output that records the last write error. The print streams above it swallow exceptions, so that a
     * command would report success.
     */
    private static final class StandardOutput extends FilterOutputStream {
        /** A reader that stops early, such as {@code head}, is no error. */
        private static final String READER_GONE = "Broken pipe";

        private volatile @Nullable String lost;

        StandardOutput(OutputStream to) {
            super(to);
        }

        @Override
        public void write(int single) throws IOException {
            write(new byte[] {(byte) single}, 0, 1);
        }

        @Override
        public void write(byte[] bytes, int offset, int length) throws IOException {
            try {
                out.write(bytes, offset, length);
            } catch (IOException e) {
                lost = e.getMessage();
                throw e;
            }
        }

        /** The error of the last failed write; null if there was none, or if only the reader has closed the pipe. */
        @Nullable
        String lost() {
            return READER_GONE.equals(lost) ? null : lost;
        }
    }
}
