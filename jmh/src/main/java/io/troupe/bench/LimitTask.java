package io.troupe.bench;

/**
 * A message that the thread of {@link Limit} runs. A class and not an interface, because a virtual call is the cheapest
 * way to tell types apart.
 */
public abstract class LimitTask {
    /** Handles this message. */
    public abstract void run();
}
