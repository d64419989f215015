package io.troupe.services.component.kinds;

import io.troupe.services.component.Component;
import java.util.List;
import java.util.Locale;

/**
 * A kind of component that an application file can name: its parameters and its factory.
 *
 * @param name the name in application files
 * @param description one line for lists of kinds
 * @param parameters the parameters that can be set
 * @param factory creates a component
 */
public record ComponentKind(String name, String description, List<Parameter> parameters, Factory factory) {
    /**
     * A parameter of a kind of component.
     *
     * @param description description of the value
     * @param defaultValue the default value; empty if the parameter is required
     */
    public record Parameter(String name, String description, String defaultValue) {}

    /** Creates components of this kind. */
    @FunctionalInterface
    public interface Factory {
        /**
         * Creates a component.
         *
         * @param name name of the component on the bus, and prefix of its topics
         * @param arguments values of the parameters
         * @throws ArgumentException if an argument is invalid
         */
        Component<?, ?> create(String name, Arguments arguments);
    }

    public ComponentKind {
        parameters = List.copyOf(parameters);
    }

    /** Description of the kind and its parameters, for a list of kinds. */
    public String describe() {
        var text = new StringBuilder(String.format(Locale.ROOT, "%-14s %s%n", name, description));
        for (var parameter : parameters) {
            text.append(String.format(
                    Locale.ROOT,
                    "    %-11s%s%s%n",
                    parameter.name() + "=",
                    parameter.description(),
                    parameter.defaultValue().isEmpty() ? " (has to be given)" : " (" + parameter.defaultValue() + ")"));
        }
        return text.toString();
    }
}
