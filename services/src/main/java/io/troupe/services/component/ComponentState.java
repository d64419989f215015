package io.troupe.services.component;

/** State of a component between invocation and termination. */
public enum ComponentState {
    NOT_INVOKED("has not been invoked"),
    INVOKING("is being invoked"),
    RUNNING("runs"),
    TERMINATING("is being terminated"),
    TERMINATED("has been terminated"),
    FAILED("has failed");

    private final String description;

    ComponentState(String description) {
        this.description = description;
    }

    /** Predicate for messages whose subject is the component, as in "hall runs". */
    public String description() {
        return description;
    }
}
