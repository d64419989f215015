package io.troupe.bench;

/**
 * A message that the thread of {@link Limit} runs: a class and not an interface, since a virtual call is the least that
 * tells types apart.
 */
public abstract class LimitTask {
    /** Handles itself. */
    public abstract void run();
}
