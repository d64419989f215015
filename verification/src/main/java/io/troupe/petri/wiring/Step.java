package io.troupe.petri.wiring;

import java.util.Optional;
import java.util.stream.Stream;

/** One way out of a state. */
sealed interface Step {
    String from();

    String to();

    /** All states that it may lead to. */
    default Stream<String> targets() {
        return Stream.of(to());
    }

    /** A step whose other side is the component in {@code role}. */
    sealed interface Outgoing extends Step {
        String role();

        /** The call or the message. */
        String call();

        default String target() {
            return role() + "." + call();
        }
    }

    /** A step that only another component or a message makes possible. */
    sealed interface Incoming extends Step {
        /** The call or the message. */
        String call();
    }

    /**
     * A step that may have to wait until something is free. A component that has chosen it stays with it, unless it
     * only {@link Protocol#tries}.
     */
    sealed interface Waiting extends Step {
        boolean tries();
    }

    /** A private step, in which no other component takes part. */
    record Does(String from, String label, String to) implements Step {}

    /** A call to the component in {@code role}; the caller waits for the answer, the rejection, or its time-out. */
    record Requests(
            String from, String role, String call, String to, Optional<String> onTimeout, Optional<String> onRejection)
            implements Outgoing {
        @Override
        public Stream<String> targets() {
            return Stream.of(Optional.of(to), onTimeout, onRejection).flatMap(Optional::stream);
        }
    }

    /** Waits for a call and answers it. */
    record Provides(String from, String call, String to) implements Incoming {}

    /** Waits for a call and accepts it, to answer or refuse it in a later state. */
    record Accepts(String from, String call, String to) implements Incoming {}

    /** Answers a call that was accepted. */
    record Answers(String from, String call, String to) implements Step {}

    /** Rejects a call that was accepted. */
    record Refuses(String from, String call, String to) implements Step {}

    /** Waits for a call and rejects it. */
    record Rejects(String from, String call, String to) implements Incoming {}

    /** Waits for a call and keeps it open as a stream. */
    record Streams(String from, String call, String to) implements Incoming {}

    /** Puts an item into the open stream of a call, if there is one. */
    record Emits(String from, String call, String to, boolean tries) implements Waiting {}

    /** Ends the open stream of a call, if there is one. */
    record Finishes(String from, String call, String to) implements Step {}

    /** A call to the component in {@code role}; the caller goes on. */
    record Asks(String from, String role, String call, String to, boolean tries) implements Outgoing, Waiting {}

    /** Takes what came back for a question. */
    record Takes(String from, Outcome outcome, String role, String call, String to) implements Outgoing {
        enum Outcome {
            ANSWER,
            REJECTION,
            END
        }
    }

    /** Gives up a question: what comes back for it is dropped. */
    record Cancels(String from, String role, String call, String to) implements Outgoing {}

    /** Puts a one-way message into the mailbox of the component in {@code role}. */
    record Sends(String from, String role, String call, String to, Optional<String> onRejection, boolean tries)
            implements Outgoing, Waiting {
        @Override
        public Stream<String> targets() {
            return Stream.of(Optional.of(to), onRejection).flatMap(Optional::stream);
        }
    }

    /** Takes the oldest message of the mailbox if it is {@code call}. */
    record Receives(String from, String call, String to) implements Incoming {}

    /** Waits for a unit of a resource and holds it from then on. */
    record Acquires(String from, String resource, String to, boolean tries) implements Waiting {}

    /** Gives a unit of a resource back. */
    record Releases(String from, String resource, String to) implements Step {}

    /** The component has ended: nothing leads out of its state. */
    record Ends(String from) implements Step {
        @Override
        public String to() {
            return from;
        }

        @Override
        public Stream<String> targets() {
            return Stream.of();
        }
    }

    /** Goes back to the first state. */
    record Stops(String from, String to) implements Step {}
}
