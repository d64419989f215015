package io.troupe.bus.internal;

/** Bytes that are no value of the expected type. The message names the component, what it holds and what it expects. */
public final class UnreadableException extends RuntimeException {
    private static final long serialVersionUID = 1;
    private static final int LONGEST_PATH = 200;

    private String path = "";

    public UnreadableException(String why) {
        super(why, null, false, false); // bytes of others are at fault, not this program: a stack trace is useless
    }

    /** Called on the way out of the nested values, innermost first. */
    public UnreadableException in(String part) {
        if (path.length() < LONGEST_PATH) {
            path = part + path;
        } else if (!path.startsWith("..")) {
            path = ".." + path;
        }
        return this;
    }

    @Override
    public String getMessage() {
        return path.isEmpty() ? String.valueOf(super.getMessage()) : path + ": " + super.getMessage();
    }
}
