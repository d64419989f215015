package io.troupe.actor;

/**
 * How many calls may wait in an actor's mailbox, and what happens to one more. A request that is cancelled holds its
 * place until its turn, because it stays in the queue until then: cancelling cannot make a bounded mailbox grow.
 *
 * {@snippet :
 * MailboxBound newestOnly = new MailboxBound(1, Overflow.DROP_OLDEST);
 * ActorSettings settings = ActorSettings.named("printer")
 *         .withMailbox(newestOnly.capacity(), newestOnly.overflow());
 * Printer printer = space.spawn(Printer.class, () -> log::add, settings);
 * printer.print("first");
 * printer.print("second"); // takes the place of the first, which becomes a dead letter
 * }
 *
 * @param capacity calls that may wait
 * @param overflow what happens to one more
 */
public record MailboxBound(int capacity, Overflow overflow) {
    /** What happens to a call when the mailbox is full. */
    public enum Overflow {
        /**
         * The new request is rejected with {@link MailboxFullException}; a new one-way message becomes a dead letter.
         */
        REJECT,
        /**
         * A caller outside every actor space waits for room, and is refused as by {@link #REJECT} when it is
         * interrupted; one on an actor space must not wait, and is treated as by {@link #REJECT}; so is everybody whose
         * actor lives in a space cranked by hand, where nobody else would make room.
         */
        BLOCK,
        /** The call that has waited longest is rejected or becomes a dead letter, to make room. */
        DROP_OLDEST
    }

    public MailboxBound {
        if (capacity < 1) {
            throw new IllegalArgumentException("capacity is " + capacity + ", expected 1 or more");
        }
        java.util.Objects.requireNonNull(overflow, "overflow");
    }
}
