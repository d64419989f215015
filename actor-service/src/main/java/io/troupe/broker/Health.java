package io.troupe.broker;

/**
 * The health of a provider.
 *
 * <p>Users meet it as {@link ServiceRecord#health}.
 */
public enum Health {
    /** Registered, and not started yet. */
    NOT_STARTED,
    STARTING,
    /** Running, and answers health checks. */
    WELL,
    /** Running, but has not answered the last health check in time; chosen only if no other provider is healthy. */
    SUSPECT,
    /** It has been stopped. */
    STOPPED,
    /** It could not be started, has ended, or has missed too many health checks. */
    FAILED
}
