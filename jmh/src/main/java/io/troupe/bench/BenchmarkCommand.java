package io.troupe.bench;

import java.io.PrintWriter;
import java.util.Collection;
import java.util.function.Function;
import java.util.regex.Pattern;
import picocli.CommandLine;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.TypeConversionException;

/**
 * The command line of a benchmark.
 *
 * <p><b>Errors.</b> A wrong option is reported on standard error with its value and what was expected, followed by the
 * usage. The exit status is then 2.
 */
public final class BenchmarkCommand {
    /** What picocli puts before the message of a converter. */
    private static final Pattern INVALID_VALUE =
            Pattern.compile("^Invalid value for option '([^']*)'(?: at index \\d+)?(?: \\([^)]*\\))?: ");

    private BenchmarkCommand() {}

    /**
     * The command line of a benchmark whose fields are annotated with its options; the last of equal options counts.
     */
    public static CommandLine of(Object benchmark) {
        ITypeConverter<Long> longs = text -> whole(text, Long::valueOf);
        var spec = CommandSpec.forAnnotatedObject(benchmark)
                .addOption(OptionSpec.builder("-h", "--help")
                        .usageHelp(true)
                        .description("prints the options")
                        .build());
        return new CommandLine(spec)
                .setOverwrittenOptionsAllowed(true)
                .registerConverter(long.class, longs)
                .setParameterExceptionHandler((wrong, given) -> report(wrong));
    }

    private static int report(ParameterException wrong) {
        PrintWriter err = wrong.getCommandLine().getErr();
        err.println(INVALID_VALUE.matcher(wrong.getMessage()).replaceFirst("$1 is "));
        wrong.getCommandLine().usage(err);
        err.flush();
        return CommandLine.ExitCode.USAGE;
    }

    private static <T> T whole(String text, Function<String, T> parse) {
        try {
            return parse.apply(text);
        } catch (NumberFormatException e) {
            throw new TypeConversionException(text + ", expected a whole number");
        }
    }

    /** The exception of a converter for a name that does not exist. */
    public static TypeConversionException unknown(String name, Collection<String> known) {
        return new TypeConversionException(name + ", expected one of " + String.join(", ", known));
    }

    /** Converts whole numbers, 1 or more. */
    public static final class AtLeastOne implements ITypeConverter<Integer> {
        @Override
        public Integer convert(String text) {
            int number = whole(text, Integer::valueOf);
            if (number < 1) {
                throw new TypeConversionException(text + ", expected 1 or more");
            }
            return number;
        }
    }
}
