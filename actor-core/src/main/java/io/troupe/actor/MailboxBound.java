package io.troupe.actor;

/**
 * The capacity of an actor's mailbox, and what happens to a call when it is full. A cancelled request occupies its
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
 * @param capacity the number of calls that may be queued
 * @param overflow what happens to a call when the mailbox is full
 */
public record MailboxBound(int capacity, Overflow overflow) {
    /** What happens to a call when the mailbox is full. */
    public enum Overflow {
        /**
         * The new request is rejected with {@link MailboxFullException}; a new one-way message becomes a dead letter.
         */
        REJECT,
        /**
         * A caller outside every actor space waits for room; if it is interrupted, the call is rejected as by
         * {@link #REJECT}. A caller on the thread of a space must not wait, and its call is treated as by
         * {@link #REJECT}. The same holds for every caller of an actor in a space without a thread, where no other
         * thread would make room.
         */
        BLOCK,
        /** The oldest queued call is rejected, or becomes a dead letter, to make room. */
        DROP_OLDEST
    }

    public MailboxBound {
        if (capacity < 1) {
            throw new IllegalArgumentException("capacity is " + capacity + ", expected 1 or more");
        }
        java.util.Objects.requireNonNull(overflow, "overflow");
    }
}
