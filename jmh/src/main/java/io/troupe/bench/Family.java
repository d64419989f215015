package io.troupe.bench;

/**
 * An actor with ten message types, as one contender writes it.
 *
 * <p><b>Role.</b> {@link FamilyLoader} loads an implementation with its nested classes again and again, so that ten
 * types in the source become as many as a large program has: each copy has message types, closures and call sites of
 * its own. It is public because a copy is in a package of its own.
 *
 * <p><b>Threads.</b> Called by one thread outside the actors.
 */
public interface Family {
    /** How many message types it has. */
    int TYPES = 10;

    /** Sends a message of each type; the receiver adds the amount, times one to ten, to its {@link Tally}. */
    void send(int amount);
}
