package io.troupe.services.component;

/** State of a component between invocation and termination. */
public enum Lifecycle {
    NOT_INVOKED("has not been invoked"),
    INVOKING("is being invoked"),
    RUNNING("runs"),
    TERMINATING("is being terminated"),
    TERMINATED("has been terminated"),
    FAILED("has failed");

    private final String words;

    Lifecycle(String words) {
        this.words = words;
    }

    /** Predicate for messages whose subject is the component, as in "hall runs". */
    public String words() {
        return words;
    }
}
