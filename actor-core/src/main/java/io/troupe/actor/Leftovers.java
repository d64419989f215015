package io.troupe.actor;

import java.util.List;

/**
 * What a space had not done when it was closed. Each call among it has been rejected: a one-way message became a dead
 * letter, the promise of a request was rejected.
 *
 * {@snippet :
 * Leftovers left = space.close(Duration.ofSeconds(5));
 * if (!left.isEmpty()) {
 *     System.getLogger("shop").log(System.Logger.Level.WARNING, "not done: " + left);
 * }
 * }
 *
 * @param messages queued one-way messages
 * @param requests queued requests that were not cancelled
 * @param openRequests requests that had begun and were not answered when their actors were stopped
 * @param tasks other queued entries: tasks of {@code execute} and {@code onIdle}, actors that had not started, rounds
 *     of repetitions, and internal tasks
 * @param timers timers that were not due, including periodic ones
 * @param sequences bodies of {@code sequential} that had not ended
 * @param examples the first queued calls, then the first that had begun, at most {@value #EXAMPLES}, each with its
 *     arguments and its actor
 */
public record Leftovers(
        int messages, int requests, int openRequests, int tasks, int timers, int sequences, List<String> examples) {
    static final int EXAMPLES = 20;

    public Leftovers {
        examples = List.copyOf(examples);
    }

    /** True if no call and no task was left; timers may have been. */
    public boolean isEmpty() {
        return messages + requests + openRequests + tasks + sequences == 0;
    }

    @Override
    public String toString() {
        return messages + " messages, " + requests + " requests, " + openRequests + " open requests, " + tasks
                + " tasks, " + timers + " timers and " + sequences + " sequential bodies"
                + (examples.isEmpty() ? "" : ", the first: " + examples);
    }
}
