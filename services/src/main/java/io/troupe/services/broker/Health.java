package io.troupe.services.broker;

/** How a provider is. */
public enum Health {
    /** It is registered, and has not been started. */
    NOT_STARTED,
    STARTING,
    /** It runs and answers. */
    WELL,
    /** It has not answered the last question for its health in time; it is chosen only when no other is well. */
    SUSPECT,
    /** It has been stopped. */
    STOPPED,
    /** It could not be started, died, or has not answered for too long. */
    FAILED
}
