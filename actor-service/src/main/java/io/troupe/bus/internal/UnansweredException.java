package io.troupe.bus.internal;

/**
 * Thrown by a request handler of this library in place of an answer, if the work was not begun or will not be
 * completed: the request is rejected by the bus, not by the handler.
 */
public final class UnansweredException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean begun;

    private UnansweredException(String why, boolean begun) {
        super(why, null, false, false); // not an error of this program: a stack trace is useless
        this.begun = begun;
    }

    /** The work was not begun: the request is rejected as if it had not reached a handler. */
    public static UnansweredException notBegun(String why) {
        return new UnansweredException(why, false);
    }

    /** The work may have been begun, and will not be answered. */
    public static UnansweredException abandoned(String why) {
        return new UnansweredException(why, true);
    }

    /** Returns whether the work may have been begun. */
    public boolean mayHaveBegun() {
        return begun;
    }
}
