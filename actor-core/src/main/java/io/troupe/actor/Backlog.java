package io.troupe.actor;

/**
 * Which of the results that are queued for a slow subscriber are kept.
 *
 * <p><b>Role.</b> Chosen by the receiving side: of a {@link Topic}, or of a {@link Callback} by its
 * {@link Callback.Stream}. Senders never wait.
 *
 * {@snippet :
 * Callback.Stream<Integer> newest = colours.subscribe(Backlog.NEWEST, colour -> log.add("saw " + colour));
 * colours.publish(0xFF0000);
 * colours.publish(0x00FF00); // replaces the first, unless that was received meanwhile
 * long lost = newest.skipped();
 * }
 *
 * <p><b>Order.</b> The results that are kept arrive in the order in which they were sent. A result that replaces the
 * oldest one takes its turn, so it may overtake other callbacks that its sender queued in between. The end is always
 * delivered, after the results.
 *
 * @param most the number of results that may be queued; one more replaces the oldest of them
 */
public record Backlog(int most) {
    /** Every result, whatever memory that takes; the default. */
    public static final Backlog ALL = new Backlog(Integer.MAX_VALUE);

    /** The newest result only: for sensors, whose older values are of no use. */
    public static final Backlog NEWEST = new Backlog(1);

    public Backlog {
        if (most < 1) {
            throw new IllegalArgumentException("most is " + most + ", expected 1 or more");
        }
    }

    /** The newest {@code most} results. */
    public static Backlog newest(int most) {
        return new Backlog(most);
    }

    boolean isBounded() {
        return most != Integer.MAX_VALUE;
    }
}
