package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Behaviour;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A supplier of behaviours that a table file can express: a kind of the catalogue and its arguments. Two are equal if
 * kind and arguments are.
 *
 * @param arguments in the table file's syntax, without the parentheses
 * @param yields whether the behaviour sometimes returns no velocity
 */
record ServiceDefinition(String kind, String arguments, boolean yields, Supplier<Behaviour> maker)
        implements Supplier<Behaviour> {
    @Override
    public Behaviour get() {
        return maker.get();
    }

    @Override
    public boolean equals(@Nullable Object other) {
        return other instanceof ServiceDefinition that && kind.equals(that.kind) && arguments.equals(that.arguments);
    }

    @Override
    public int hashCode() {
        return 31 * kind.hashCode() + arguments.hashCode();
    }

    @Override
    public String toString() {
        return arguments.isEmpty() ? kind : kind + "(" + arguments + ")";
    }
}
