package io.troupe.actor;

/**
 * A task with a deadline, as returned by {@code after(..)} and {@code every(..)} of an actor's context.
 *
 * {@snippet :
 * public void pause() {
 *     if (cycle != null) {
 *         cycle.cancel();
 *     }
 * }
 * }
 *
 * <p><b>Threads.</b> The thread of its space.
 */
public interface Timer {
    /**
     * Cancels the task.
     *
     * @return false if it has run (and is not periodic) or was cancelled before
     * @throws IllegalStateException on a thread other than that of its space
     */
    boolean cancel();

    /** True if it has not run and was not cancelled. */
    boolean isWaiting();
}
