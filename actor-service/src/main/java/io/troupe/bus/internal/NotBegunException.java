package io.troupe.bus.internal;

/**
 * Thrown by a request handler of this library in place of an answer, if it has not begun the work: the bus rejects the
 * request as if it had not reached a handler.
 */
public final class NotBegunException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    public NotBegunException(String why) {
        super(why, null, false, false); // not an error of this program: a stack trace is useless
    }
}
