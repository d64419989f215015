package io.troupe.bus;

import io.troupe.bus.internal.Portable;
import java.util.Objects;

/**
 * A named operation: requests of one type, answered by replies of another.
 *
 * {@snippet :
 * record Setpoint(double celsius) {}
 *
 * record Accepted(boolean heats) {}
 *
 * static final Operation<Setpoint, Accepted> HEAT =
 *         new Operation<>("heat", Setpoint.class, Accepted.class, Operation.Kind.CONTROL);
 * }
 *
 * <p><b>Units and shapes.</b> Both types are records of values that can leave a process; the constructor rejects any
 * other type and names the component that is at fault. The rules for values of a {@link BusTopic} apply to requests and
 * replies as well.
 */
public record Operation<Q extends Record, A extends Record>(String name, Class<Q> request, Class<A> reply, Kind kind) {
    public Operation {
        if (name.isBlank()) {
            throw new IllegalArgumentException("the name of an operation is blank");
        }
        Portable.check("operation " + name, request);
        Portable.check("operation " + name, reply);
        Objects.requireNonNull(kind, "kind");
    }

    /** Service-specific data, or the management of services (paper, section 2.2.3). */
    public enum Kind {
        DATA,
        CONTROL
    }
}
