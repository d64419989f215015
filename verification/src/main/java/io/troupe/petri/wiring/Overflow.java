package io.troupe.petri.wiring;

/** What happens to a one-way message when the mailbox of its receiver is full. */
public enum Overflow {
    /** The sender waits until there is room. */
    BLOCK,
    /** The message is lost; the sender goes on, in the state of {@link Branch#orRejected} if it declares one. */
    REJECT,
    /** The oldest message of the mailbox is lost to make room. */
    DROP_OLDEST
}
