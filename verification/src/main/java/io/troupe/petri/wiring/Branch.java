package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.EnumSet;
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
        ACCEPTS("accepts", false),
        ANSWERS("answers", false),
        REFUSES("refuses", false),
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
        STOPS("stops", false),
        ENDS("ends", false);

        /** Those that may have to wait, and may be tried. */
        static final Set<Kind> WAITING = EnumSet.of(ACQUIRES, SENDS, EMITS, ASKS);

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

    private final Builder step;
    private final String to;
    private final Optional<String> onTimeout;
    private final Optional<String> onRejection;

    private Branch(Builder step, String to, Optional<String> onTimeout, Optional<String> onRejection) {
        this.step = step;
        this.to = to;
        this.onTimeout = onTimeout;
        this.onRejection = onRejection;
    }

    /** A branch whose target state is still missing. */
    public static final class Builder {
        private final Kind kind;
        private final String what;
        private final boolean tries;

        Builder(Kind kind, String what) {
            this(kind, what, false);
        }

        private Builder(Kind kind, String what, boolean tries) {
            this.kind = kind;
            this.what = requireNonNull(what, "what");
            this.tries = tries;
        }

        Builder tries() {
            requireKind("waits and can be tried", Kind.WAITING);
            return new Builder(kind, what, true);
        }

        private void requireKind(String event, Set<Kind> kinds) {
            if (!kinds.contains(kind)) {
                throw new IllegalStateException("\"" + this + "\" never " + event + "; expected a step of "
                        + kinds.stream().map(each -> each.verb).sorted().toList());
            }
        }

        /** Sets the target state. */
        public Branch then(String state) {
            return new Branch(this, requireNonNull(state, "state"), Optional.empty(), Optional.empty());
        }

        /** For example {@code provides setValues}. */
        @Override
        public String toString() {
            return what.isEmpty() ? kind.verb : kind.verb + " " + what;
        }
    }

    /** Of a step by its word, for example {@code provides}. */
    static Branch of(String verb, String what, String to) {
        for (var kind : Kind.values()) {
            if (kind.verb.equals(verb)) {
                return new Builder(kind, what).then(to);
            }
        }
        throw new IllegalArgumentException("there is no step " + verb);
    }

    /**
     * Lets a request time out at any moment before its answer. A request that was not accepted yet is withdrawn; the
     * answer of one that is being served comes too late and is dropped.
     */
    public Branch orTimeout(String state) {
        step.requireKind("times out", Set.of(Kind.REQUESTS));
        return new Branch(step, to, Optional.of(requireNonNull(state, "state")), onRejection);
    }

    /** Sets the state after a rejected request, or after a message that a full mailbox rejected. */
    public Branch orRejected(String state) {
        step.requireKind("is rejected", Set.of(Kind.REQUESTS, Kind.SENDS));
        return new Branch(step, to, onTimeout, Optional.of(requireNonNull(state, "state")));
    }

    /** This branch as a step out of {@code state}; a stop leads to {@code first}. */
    Step from(String state, String first) {
        var what = what();
        return switch (kind()) {
            case DOES -> new Step.Does(state, what, to);
            case REQUESTS -> new Step.Requests(state, role(), call(), to, onTimeout, onRejection);
            case PROVIDES -> new Step.Provides(state, what, to);
            case ACCEPTS -> new Step.Accepts(state, what, to);
            case ANSWERS -> new Step.Answers(state, what, to);
            case REFUSES -> new Step.Refuses(state, what, to);
            case REJECTS -> new Step.Rejects(state, what, to);
            case STREAMS -> new Step.Streams(state, what, to);
            case EMITS -> new Step.Emits(state, what, to, step.tries);
            case FINISHES -> new Step.Finishes(state, what, to);
            case ASKS -> new Step.Asks(state, role(), call(), to, step.tries);
            case ANSWERED -> new Step.Takes(state, Step.Takes.Outcome.ANSWER, role(), call(), to);
            case REJECTED -> new Step.Takes(state, Step.Takes.Outcome.REJECTION, role(), call(), to);
            case FINISHED -> new Step.Takes(state, Step.Takes.Outcome.END, role(), call(), to);
            case CANCELS -> new Step.Cancels(state, role(), call(), to);
            case SENDS -> new Step.Sends(state, role(), call(), to, onRejection, step.tries);
            case RECEIVES -> new Step.Receives(state, what, to);
            case ACQUIRES -> new Step.Acquires(state, what, to, step.tries);
            case RELEASES -> new Step.Releases(state, what, to);
            case STOPS -> new Step.Stops(state, first);
            case ENDS -> new Step.Ends(state);
        };
    }

    private String role() {
        return what().substring(0, what().indexOf('.'));
    }

    private String call() {
        return what().substring(what().indexOf('.') + 1);
    }

    Kind kind() {
        return step.kind;
    }

    String what() {
        return step.what;
    }

    String to() {
        return to;
    }

    /** For example {@code provides setValues}. */
    @Override
    public String toString() {
        return step.toString();
    }
}
