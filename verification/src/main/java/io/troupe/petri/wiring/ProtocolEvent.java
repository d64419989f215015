package io.troupe.petri.wiring;

/**
 * Something that a component of a {@link Wiring} was seen to do.
 *
 * <p><b>Role.</b> Given to a {@link WiringMonitor}, which keeps the last ones for its story; {@link Conformance} takes
 * all of a run.
 *
 * @param component the component that does it; of an answer or a rejection its caller, of a message from outside its
 *     receiver
 * @param what as described in {@link Kind}
 */
public record ProtocolEvent(Kind kind, String component, String what) {
    /**
     * What can be seen. A call, its answer and all that a caller does with it are written {@code component.call}, with
     * the component that provides the call; so is a message that is sent.
     */
    public enum Kind {
        /** The caller makes a call; if it {@link Protocol#requests} it, it waits from now on. */
        ASKED,
        /** The other component accepts the call, or opens its stream. */
        TAKEN,
        /** The other component has answered. An error is an answer, too, if no rejection is declared. */
        ANSWERED,
        /**
         * The other component rejects the call, instead of accepting it or after that. A failure rejects what is
         * served, by itself.
         */
        REJECTED,
        /** The caller does not wait for its request any more. */
        TIMED_OUT,
        /** The caller takes the answer to its question, or the next item of the stream. */
        GOT_ANSWER,
        /** The caller takes the rejection of its question. */
        GOT_REJECTION,
        /** The caller takes the end of the stream. */
        GOT_END,
        /** The caller cancels its question. */
        GAVE_UP,
        /** A component puts an item into its stream; the call alone. */
        EMITTED,
        /** A component ends its stream; the call alone. */
        FINISHED,
        /** A message is put into a mailbox, which drops its oldest one if it is full and declared so. */
        SENT,
        /** A message is rejected by a full mailbox. */
        REFUSED,
        /** A component takes a message out of its mailbox; the message alone. */
        RECEIVED,
        /** A message comes from outside; the message alone. */
        ARRIVED,
        /** A component gets a unit of a resource; its name. */
        ACQUIRED,
        /** A component gives a unit of a resource back; its name. */
        RELEASED,
        /** A component fails; empty. */
        FAILED,
        /**
         * A component begins a step that has to wait: the resource, the message or call as {@code component.call}, or
         * the call of its stream alone. It need not be reported; if it is, {@link WiringMonitor#idle} knows that the
         * component does nothing else meanwhile.
         */
        WAITS,
        /** A private step that is observed, by its label. */
        DID
    }

    /** Whether it is about a call, or a message that is sent. */
    boolean hasTarget() {
        return switch (kind) {
            case EMITTED, FINISHED, RECEIVED, ARRIVED, ACQUIRED, RELEASED, FAILED, WAITS, DID -> false;
            default -> true;
        };
    }

    /** The component on the other side; the same one if there is none. */
    String provider() {
        return hasTarget() ? what.substring(0, Math.max(0, what.indexOf('.'))) : component;
    }

    private String call() {
        return what.substring(what.indexOf('.') + 1);
    }

    /** For example {@code robot asks player.setValues}. */
    @Override
    public String toString() {
        return switch (kind) {
            case ASKED -> component + " asks " + what;
            case TAKEN -> provider() + " takes " + call() + " from " + component;
            case ANSWERED -> provider() + " answers " + call() + " to " + component;
            case REJECTED -> provider() + " rejects " + call() + " of " + component;
            case TIMED_OUT -> component + " waits no longer for " + what;
            case GOT_ANSWER -> component + " gets the answer of " + what;
            case GOT_REJECTION -> component + " gets the rejection of " + what;
            case GOT_END -> component + " gets the end of " + what;
            case GAVE_UP -> component + " gives up " + what;
            case EMITTED -> component + " emits " + what;
            case FINISHED -> component + " finishes " + what;
            case SENT -> component + " sends " + what;
            case REFUSED -> component + " sends " + what + ", which is rejected";
            case RECEIVED -> component + " receives " + what;
            case ARRIVED -> component + " is sent " + what + " from outside";
            case ACQUIRED -> component + " takes " + what;
            case RELEASED -> component + " gives back " + what;
            case FAILED -> component + " fails";
            case WAITS -> component + " waits for " + what;
            case DID -> component + ": " + what;
        };
    }

    /** What one of the components may do, for example {@code ask player.setValues}; empty if it is not its choice. */
    String asOptionOf(String who) {
        if (hasTarget() && who.equals(provider())) {
            return switch (kind) {
                case TAKEN -> "take " + call();
                case ANSWERED -> "answer " + call();
                case REJECTED -> "reject " + call();
                default -> "";
            };
        }
        if (!who.equals(component)) {
            return "";
        }
        return switch (kind) {
            case ASKED -> "ask " + what;
            case TAKEN -> "have " + what + " accepted";
            case ANSWERED, GOT_ANSWER -> "get the answer of " + what;
            case REJECTED, GOT_REJECTION -> "get the rejection of " + what;
            case TIMED_OUT -> "wait no longer for " + what;
            case GOT_END -> "get the end of " + what;
            case GAVE_UP -> "give up " + what;
            case EMITTED -> "emit " + what;
            case FINISHED -> "finish " + what;
            case SENT, REFUSED -> "send " + what;
            case RECEIVED -> "receive " + what;
            case ARRIVED -> "be sent " + what + " from outside";
            case ACQUIRED -> "take " + what;
            case RELEASED -> "give back " + what;
            case FAILED, WAITS -> ""; // always, where it may
            case DID -> "do \"" + what + "\"";
        };
    }
}
