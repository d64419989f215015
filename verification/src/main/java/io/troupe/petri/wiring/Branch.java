package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.Optional;
import java.util.Set;

/**
 * A branch, that is a way out of a state of a {@link Protocol}: a step, and the state after it.
 *
 * <p><b>Role.</b> Made by the static methods of {@link Protocol}, for example {@link Protocol#does}; argument of
 * {@link ProtocolBuilder#state}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> {@link #orTimeout} and {@link #orRejected} throw {@link IllegalStateException} for a step that
 * cannot time out or be rejected.
 */
public final class Branch {
    enum Kind {
        DOES("does", false),
        REQUESTS("requests", true),
        PROVIDES("provides", false),
        REJECTS("rejects", false),
        STREAMS("streams", false),
        EMITS("emits", false),
        FINISHES("finishes", false),
        ASKS("asks", true),
        ANSWERED("answered", true),
        REJECTED("rejected", true),
        FINISHED("finished", true),
        CANCELS("cancels", true),
        SENDS("sends", true),
        RECEIVES("receives", false),
        ACQUIRES("acquires", false),
        RELEASES("releases", false),
        STOPS("stops", false);

        private final String verb;
        private final boolean hasTarget;

        Kind(String verb, boolean hasTarget) {
            this.verb = verb;
            this.hasTarget = hasTarget;
        }

        /** Whether its word is {@code component.call}. */
        boolean hasTarget() {
            return hasTarget;
        }
    }

    private final Kind kind;
    private final String what;
    private final String to;
    private final Optional<String> onTimeout;
    private final Optional<String> onRejection;

    Branch(Kind kind, String what, String to) {
        this(kind, what, to, Optional.empty(), Optional.empty());
    }

    private Branch(Kind kind, String what, String to, Optional<String> onTimeout, Optional<String> onRejection) {
        this.kind = kind;
        this.what = what;
        this.to = to;
        this.onTimeout = onTimeout;
        this.onRejection = onRejection;
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

    /** Of a step by its word, for example {@code provides}. */
    static Branch of(String verb, String what, String to) {
        for (var kind : Kind.values()) {
            if (kind.verb.equals(verb)) {
                return new Branch(kind, what, to);
            }
        }
        throw new IllegalArgumentException("there is no step " + verb);
    }

    /**
     * Lets a request time out at any moment before its answer. A request that was not accepted yet is withdrawn; the
     * answer of one that is being served comes too late and is dropped.
     */
    public Branch orTimeout(String state) {
        requireKind("times out", Set.of(Kind.REQUESTS));
        return new Branch(kind, what, to, Optional.of(requireNonNull(state, "state")), onRejection);
    }

    /** Sets the state after a rejected request, or after a message that a full mailbox rejected. */
    public Branch orRejected(String state) {
        requireKind("is rejected", Set.of(Kind.REQUESTS, Kind.SENDS));
        return new Branch(kind, what, to, onTimeout, Optional.of(requireNonNull(state, "state")));
    }

    private void requireKind(String event, Set<Kind> kinds) {
        if (!kinds.contains(kind)) {
            throw new IllegalStateException("\"" + this + "\" never " + event + "; expected a step of "
                    + kinds.stream().map(each -> each.verb).sorted().toList());
        }
    }

    /** This branch as a step out of {@code state}; a stop leads to {@code first}. */
    Step from(String state, String first) {
        return switch (kind) {
            case DOES -> new Step.Does(state, what, to);
            case REQUESTS -> new Step.Requests(state, role(), call(), to, onTimeout, onRejection);
            case PROVIDES -> new Step.Provides(state, what, to);
            case REJECTS -> new Step.Rejects(state, what, to);
            case STREAMS -> new Step.Streams(state, what, to);
            case EMITS -> new Step.Emits(state, what, to);
            case FINISHES -> new Step.Finishes(state, what, to);
            case ASKS -> new Step.Asks(state, role(), call(), to);
            case ANSWERED -> new Step.Takes(state, Step.Takes.Outcome.ANSWER, role(), call(), to);
            case REJECTED -> new Step.Takes(state, Step.Takes.Outcome.REJECTION, role(), call(), to);
            case FINISHED -> new Step.Takes(state, Step.Takes.Outcome.END, role(), call(), to);
            case CANCELS -> new Step.Cancels(state, role(), call(), to);
            case SENDS -> new Step.Sends(state, role(), call(), to, onRejection);
            case RECEIVES -> new Step.Receives(state, what, to);
            case ACQUIRES -> new Step.Acquires(state, what, to);
            case RELEASES -> new Step.Releases(state, what, to);
            case STOPS -> new Step.Stops(state, first);
        };
    }

    private String role() {
        return what.substring(0, what.indexOf('.'));
    }

    private String call() {
        return what.substring(what.indexOf('.') + 1);
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
        return kind == Kind.STOPS ? kind.verb : kind.verb + " " + what;
    }
}
