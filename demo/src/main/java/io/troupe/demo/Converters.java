package io.troupe.demo;

import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.util.function.Function;
import picocli.CommandLine;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.TypeConversionException;

/** picocli converters for numbers and paths, with plain error messages. */
final class Converters {
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
