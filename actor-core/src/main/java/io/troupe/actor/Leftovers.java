package io.troupe.actor;

import java.util.List;

/**
 * What a space had not done when it was closed. Each call among it has been refused: a message as a dead letter, a
 * request by rejection.
 *
 * {@snippet :
 * Leftovers left = space.close(Duration.ofSeconds(5));
 * if (!left.isEmpty()) {
 *     System.getLogger("shop").log(System.Logger.Level.WARNING, "not done: " + left);
 * }
 * }
 *
 * @param messages one-way calls that waited
 * @param requests requests that waited and were not cancelled
 * @param openRequests requests that had begun, and whose answers were not settled when their actors were stopped
 * @param tasks other entries that waited: tasks of {@code execute} and {@code onIdle}, actors that had not started,
 *     rounds of repetitions, and the library's own
 * @param timers timers that were not due, periodic ones included
 * @param sequences bodies of {@code sequential} that had not ended
 * @param examples the first calls of those that waited and then of those that had begun, at most {@value #EXAMPLES},
 *     each with its arguments and its actor
 */
public record Leftovers(
        int messages, int requests, int openRequests, int tasks, int timers, int sequences, List<String> examples) {
    static final int EXAMPLES = 20;

    public Leftovers {
        examples = List.copyOf(examples);
    }

    /** Whether no call and no task was left; timers may have been. */
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
