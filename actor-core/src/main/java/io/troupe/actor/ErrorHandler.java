package io.troupe.actor;

/**
 * Is told what went wrong where nobody else could be told: a one-way message, a timer or a listener threw, or a promise
 * was rejected and nobody listened.
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
    /** @param where names the actor and the method, as far as known */
    void handle(String where, Throwable error);
}
