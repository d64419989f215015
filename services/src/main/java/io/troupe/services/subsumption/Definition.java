package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Behaviour;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A behaviour that can be written down: a kind of the catalogue and its arguments, by which alone two are compared.
 *
 * @param arguments as a table's file has them, between the brackets
 * @param yields whether it has nothing to say at times
 */
record Definition(String kind, String arguments, boolean yields, Supplier<Behaviour> maker)
        implements Supplier<Behaviour> {
    @Override
    public Behaviour get() {
        return maker.get();
    }

    @Override
    public boolean equals(@Nullable Object other) {
        return other instanceof Definition that && kind.equals(that.kind) && arguments.equals(that.arguments);
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
