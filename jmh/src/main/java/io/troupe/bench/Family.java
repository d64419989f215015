package io.troupe.bench;

/**
 * An actor with ten message types, written as a user of one contender would write it.
 *
 * <p><b>Role.</b> A benchmark with a few message types flatters every library: the compiler inlines the few types it
 * has met at each call site. A large program has hundreds. So {@link Families} loads each implementation, with its
 * nested classes, twenty times, and each copy has separate message types, closures and call sites. The implementations
 * are public because a copy lies in another run-time package than the harness.
 *
 * <p><b>Threads.</b> Called by one thread outside the actors.
 */
public interface Family {
    /** The number of message types. */
    int TYPES = 10;

    /** Sends a message of each type; the receiver adds the amount, times one to ten, to its {@link Tally}. */
    void send(int amount);
}
