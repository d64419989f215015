package io.troupe.bench;

/**
 * What the actor of a {@link Family} counts.
 *
 * <p><b>Threads.</b> {@link #expect} and {@link #sum} are for the sender before the first and after the last message,
 * {@link #add} is for the actor; the messages themselves order the two.
 */
public final class Tally {
    private final Runnable last;
    private int left;
    private long sum;

    /** Runs the action with the last message that is expected. */
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

    /** One message was handled. */
    public void add(int amount) {
        sum += amount;
        if (--left == 0) {
            last.run();
        }
    }
}
