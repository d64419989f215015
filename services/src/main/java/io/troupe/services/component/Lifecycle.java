package io.troupe.services.component;

/** Where a component stands between invocation and termination. */
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

    /** As it stands in a sentence about the component. */
    public String words() {
        return words;
    }
}
