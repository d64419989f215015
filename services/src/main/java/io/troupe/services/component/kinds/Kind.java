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
 * @param maker creates a component
 */
public record Kind(String name, String description, List<Parameter> parameters, Maker maker) {
    /**
     * A parameter of a kind of component.
     *
     * @param meaning description of the value
     * @param usual the default value; empty if the parameter is required
     */
    public record Parameter(String name, String meaning, String usual) {}

    /** Creates components of this kind. */
    @FunctionalInterface
    public interface Maker {
        /**
         * Creates a component.
         *
         * @param name name of the component on the bus, and prefix of its topics
         * @param arguments values of the parameters
         * @throws ArgumentException if an argument is invalid
         */
        Component<?, ?> make(String name, Arguments arguments);
    }

    public Kind {
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
                    parameter.meaning(),
                    parameter.usual().isEmpty() ? " (has to be given)" : " (" + parameter.usual() + ")"));
        }
        return text.toString();
    }
}
