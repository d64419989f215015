package io.troupe.actor;

import java.time.Duration;

/**
 * Counters of the work that a space has done, and of its backlog.
 *
 * {@snippet :
 * SpaceMetrics metrics = space.metrics();
 * String line = metrics.actors() + " actors, " + metrics.waiting() + " waiting, behind by " + metrics.latency();
 * }
 *
 * <p><b>Threads.</b> Any thread. <b>Cost.</b> Constant, and none while no method is called. The backlog is measured by
 * a probe that is queued like a message. Each call of {@link #waiting} or {@link #latency} sends a probe unless one is
 * queued, and returns the result of the last one. So call them periodically, as a monitor does. In a space without a
 * thread no probe is sent: the entries in the queues are counted, which is exact between two runs.
 */
public interface SpaceMetrics {
    /** Messages, requests, callbacks, timers and tasks processed since the space was created. */
    long served();

    /** Entries that were processed before the last probe. */
    long waiting();

    /**
     * How long the last probe was queued or, if that is more, how long the current one has been; by the machine's
     * clock.
     */
    Duration latency();

    /** Actors that have started and not stopped. */
    int actors();

    /** Timers that are set. */
    int timers();

    /** Errors reported to error handlers. */
    long errors();

    /** Messages that were not delivered. */
    long deadLetters();

    /** Requests that were not begun, because their callers had cancelled them or their time limits had passed. */
    long abandoned();

    /** Time limits of promises that have passed: those set in this space, or outside every space on its promises. */
    long expired();
}
