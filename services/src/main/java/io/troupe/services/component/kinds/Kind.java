package io.troupe.services.component.kinds;

import io.troupe.services.component.Component;
import java.util.List;
import java.util.Locale;

/**
 * A kind of component that a declaration can name.
 *
 * @param parameters what can be said of one
 * @param maker makes one
 */
public record Kind(String name, String description, List<Parameter> parameters, Maker maker) {
    /**
     * Something that can be said of a component.
     *
     * @param usual the value if nothing is said; empty if something has to be
     */
    public record Parameter(String name, String meaning, String usual) {}

    /** Makes a component. */
    @FunctionalInterface
    public interface Maker {
        /**
         * @param name of the component, and of its topics
         * @throws ArgumentException if one of the arguments does not make sense
         */
        Component<?, ?> make(String name, Arguments arguments);
    }

    public Kind {
        parameters = List.copyOf(parameters);
    }

    /** As it stands in a list of kinds. */
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
