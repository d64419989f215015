package io.troupe.actor;

/**
 * Receives errors that have no caller: a one-way message, a timer or a listener threw, or a promise without a listener
 * was rejected.
 *
 * {@snippet :
 * ErrorHandler handler = (where, error) -> log.add(where + " failed: " + error.getMessage());
 * SpaceSettings settings = SpaceSettings.named("shop").withOnError(handler);
 * }
 *
 * <p><b>Threads.</b> The space's thread. <b>Errors.</b> Must not throw; what it throws is logged.
 */
@FunctionalInterface
public interface ErrorHandler {
    /**
     * Handles an error.
     *
     * @param where names the actor and the method, as far as known
     */
    void handle(String where, Throwable error);
}
