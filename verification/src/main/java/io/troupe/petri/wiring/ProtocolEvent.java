package io.troupe.petri.wiring;

/**
 * Something that a component of a {@link Wiring} was seen to do.
 *
 * <p><b>Role.</b> Given to a {@link WiringMonitor}, which keeps the last ones for its story; {@link Conformance} takes
 * all of a run.
 *
 * @param component the caller; of a private step the component
 * @param what the call, as {@code component.call} of the component that answers it; of a private step its label
 */
public record ProtocolEvent(Kind kind, String component, String what) {
    /** What can be seen. */
    public enum Kind {
        /** The caller makes a call, and waits from now on. */
        ASKED,
        /** The other component accepts the call. */
        TAKEN,
        /** The other component has answered; both go on. An error is an answer, too. */
        ANSWERED,
        /** A private step. */
        DID
    }

    /** The component that answers; of a private step the component itself. */
    String provider() {
        return kind == Kind.DID ? component : what.substring(0, what.indexOf('.'));
    }

    String call() {
        return what.substring(what.indexOf('.') + 1);
    }

    /** For example {@code robot asks player.setValues}. */
    @Override
    public String toString() {
        return switch (kind) {
            case ASKED -> component + " asks " + what;
            case TAKEN -> provider() + " takes " + call() + " from " + component;
            case ANSWERED -> provider() + " answers " + call() + " to " + component;
            case DID -> component + ": " + what;
        };
    }
}
