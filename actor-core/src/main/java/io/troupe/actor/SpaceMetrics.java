package io.troupe.actor;

import java.time.Duration;

/**
 * How much a space has done and how far it is behind.
 *
 * {@snippet :
 * SpaceMetrics metrics = space.metrics();
 * String line = metrics.actors() + " actors, " + metrics.waiting() + " waiting, behind by " + metrics.latency();
 * }
 *
 * <p><b>Threads.</b> Any thread. <b>Cost.</b> Constant, and nothing while nobody asks: how far the space is behind is
 * found out by a probe that waits its turn in the queue like a message. Each look at {@link #waiting} or
 * {@link #latency} sends one unless one is on its way, and answers what the last one found; so look regularly, as a
 * monitor does. In a space cranked by hand no probe is sent: the queues themselves are counted, exactly between cranks.
 */
public interface SpaceMetrics {
    /** Messages, requests, callbacks, timers and tasks served since the space was made. */
    long served();

    /** Entries that waited in front of the last probe. */
    long waiting();

    /** How long the last probe waited, or, if that is more, how long the one on its way has; by the machine's clock. */
    Duration latency();

    /** Actors that have started and not stopped. */
    int actors();

    /** Timers that are set. */
    int timers();

    /** What was reported to error handlers. */
    long errors();

    /** Messages that reached nobody. */
    long deadLetters();
}
