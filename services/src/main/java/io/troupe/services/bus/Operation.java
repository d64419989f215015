package io.troupe.services.bus;

import java.util.Objects;

/**
 * A name under which questions of one type are answered by answers of another.
 *
 * <p><b>Units and shapes.</b> Both are records of values that can leave a process; anything else is refused here, by
 * the name of the component. What holds for the values of a {@link Topic} holds for questions and answers.
 */
public record Operation<Q extends Record, A extends Record>(
        String name, Class<Q> question, Class<A> answer, Kind kind) {
    public Operation {
        if (name.isBlank()) {
            throw new IllegalArgumentException("the name of an operation is blank");
        }
        Portable.check("operation " + name, question);
        Portable.check("operation " + name, answer);
        Objects.requireNonNull(kind, "kind");
    }

    /** Service-specific data, or the managing of services (paper, section 2.2.3). */
    public enum Kind {
        DATA,
        CONTROL
    }
}
