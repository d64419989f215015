package io.troupe.services.component.kinds;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Function;

/**
 * Values of the parameters of one component, as declared in an application; missing values are replaced by the defaults
 * of its kind.
 *
 * <p><b>Errors.</b> {@link ArgumentException}, which names the parameter, its value, and the expected values.
 */
public final class Arguments {
    private final ComponentKind kind;
    private final Map<String, String> declaredValues;
    private final Path directory;

    /**
     * @param kind the kind of the component
     * @param declaredValues declared values by parameter name
     * @param directory base of relative paths
     * @throws ArgumentException if the value of a required parameter is missing
     */
    public Arguments(ComponentKind kind, Map<String, String> declaredValues, Path directory) {
        this.kind = kind;
        this.declaredValues = Map.copyOf(declaredValues);
        this.directory = directory;
        for (var parameter : kind.parameters()) {
            if (parameter.defaultValue().isEmpty() && !declaredValues.containsKey(parameter.name())) {
                throw new ArgumentException(
                        parameter.name(),
                        "a component of kind " + kind.name() + " has no " + parameter.name() + ", expected "
                                + parameter.name() + "=" + parameter.description());
            }
        }
    }

    /** Base of relative paths. */
    public Path directory() {
        return directory;
    }

    public String text(String name) {
        String value = declaredValues.get(name);
        return value != null ? value : defaultValue(name);
    }

    private String defaultValue(String name) {
        return kind.parameters().stream()
                .filter(parameter -> parameter.name().equals(name))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException(kind.name() + " has no parameter " + name))
                .defaultValue();
    }

    public int integer(String name, int min, int max) {
        return integer(name, text(name), min, max);
    }

    private static int integer(String name, String text, int min, int max) {
        try {
            int value = Integer.parseInt(text.strip());
            if (value >= min && value <= max) {
                return value;
            }
        } catch (NumberFormatException e) {
            // rejected below
        }
        throw new ArgumentException(
                name, name + " is \"" + text + "\", expected a whole number from " + min + " to " + max);
    }

    /** Integers separated by commas, without duplicates. */
    public List<Integer> integers(String name, int min, int max) {
        List<Integer> values = new ArrayList<>();
        for (String text : texts(name)) {
            int value = integer(name, text, min, max);
            if (values.contains(value)) {
                throw new ArgumentException(name, name + " has " + value + " twice, expected each once");
            }
            values.add(value);
        }
        return values;
    }

    /** Words separated by commas. */
    public List<String> texts(String name) {
        return Arrays.stream(text(name).split(",")).map(String::strip).toList();
    }

    /**
     * The value whose name is given, ignoring case.
     *
     * @param values the permitted values
     * @param nameOf returns the name of a value
     */
    public <T> T oneOf(String name, List<T> values, Function<? super T, String> nameOf) {
        return oneOf(name, text(name), values, nameOf);
    }

    /**
     * The values whose names are given, separated by commas, ignoring case.
     *
     * @param values the permitted values
     * @param nameOf returns the name of a value
     */
    public <T> List<T> someOf(String name, List<T> values, Function<? super T, String> nameOf) {
        return texts(name).stream()
                .map(text -> oneOf(name, text, values, nameOf))
                .toList();
    }

    private static <T> T oneOf(String name, String text, List<T> values, Function<? super T, String> nameOf) {
        Optional<T> found = values.stream()
                .filter(value -> nameOf.apply(value).equalsIgnoreCase(text))
                .findFirst();
        return found.orElseThrow(() -> new ArgumentException(
                name,
                name + " is \"" + text + "\", expected one of "
                        + String.join(", ", values.stream().map(nameOf).toList())));
    }
}
