package io.troupe.bench;

/**
 * Counts and sums the messages of a {@link Family}'s actor.
 *
 * <p><b>Threads.</b> The sender calls {@link #expect} before the first and {@link #sum} after the last message, the
 * actor calls {@link #add}. The messages themselves order these calls.
 */
public final class Tally {
    private final Runnable last;
    private int left;
    private long sum;

    /** Runs {@code last} when the last expected message is handled. */
    Tally(Runnable last) {
        this.last = last;
    }

    void expect(int messages) {
        left = messages;
        sum = 0;
    }

    long sum() {
        return sum;
    }

    /** Counts one handled message. */
    public void add(int amount) {
        sum += amount;
        if (--left == 0) {
            last.run();
        }
    }
}
