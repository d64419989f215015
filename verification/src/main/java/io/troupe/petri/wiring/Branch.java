package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

/**
 * A branch, that is a way out of a state of a {@link Protocol}: a step, and the state after it.
 *
 * <p><b>Role.</b> Made by {@link Protocol#does}, {@link Protocol#requests}, {@link Protocol#provides} and
 * {@link Protocol#stops}; argument of {@link ProtocolBuilder#in}.
 *
 * <p><b>Threads.</b> Immutable.
 */
public final class Branch {
    enum Kind {
        DOES,
        REQUESTS,
        PROVIDES,
        STOPS
    }

    private final Kind kind;
    private final String what;
    private final String to;

    Branch(Kind kind, String what, String to) {
        this.kind = kind;
        this.what = what;
        this.to = to;
    }

    /** A branch whose target state is still missing. */
    public static final class Builder {
        private final Kind kind;
        private final String what;

        Builder(Kind kind, String what) {
            this.kind = kind;
            this.what = requireNonNull(what, "what");
        }

        /** Sets the target state. */
        public Branch then(String state) {
            return new Branch(kind, what, requireNonNull(state, "state"));
        }
    }

    /** This branch as a step out of {@code state}; a stop leads to {@code first}. */
    Step from(String state, String first) {
        return switch (kind) {
            case DOES -> new Step.Does(state, what, to);
            case REQUESTS ->
                new Step.Requests(
                        state, what.substring(0, what.indexOf('.')), what.substring(what.indexOf('.') + 1), to);
            case PROVIDES -> new Step.Provides(state, what, to);
            case STOPS -> new Step.Stops(state, first);
        };
    }

    Kind kind() {
        return kind;
    }

    String what() {
        return what;
    }

    String to() {
        return to;
    }

    /** For example {@code provides setValues}. */
    @Override
    public String toString() {
        var verb = switch (kind) {
            case DOES -> "does";
            case REQUESTS -> "requests";
            case PROVIDES -> "provides";
            case STOPS -> "stops";
        };
        return kind == Kind.STOPS ? verb : verb + " " + what;
    }
}
