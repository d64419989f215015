package io.troupe.bus;

import java.time.Duration;

/**
 * A message on its way to a port, and what is known of its way so far.
 *
 * @param incarnation the life of the node that sent it
 * @param arrivedNanos when this node got it, by the clock of its space; {@link #NOT_NOTED} if neither age nor limit
 *     matter
 * @param ageNanos how long it had been on its way then, with the ways of a forwarded value before
 * @param limitNanos how long after its arrival the requester waits for a reply; {@link Long#MAX_VALUE} if that is not
 *     limited, or known otherwise
 * @param isLimitShared true if the requests that the handler sends share the limit
 */
record MessageDelivery(
        BusMessage message,
        long incarnation,
        long arrivedNanos,
        long ageNanos,
        long limitNanos,
        boolean isLimitShared) {
    /** The time of arrival of a message for which it does not matter: reading the clock costs time. */
    static final long NOT_NOTED = Long.MIN_VALUE;

    MessageDelivery(BusMessage message, long incarnation, long arrivedNanos, long ageNanos, long limitNanos) {
        this(message, incarnation, arrivedNanos, ageNanos, limitNanos, false);
    }

    /** A message within this node. */
    static MessageDelivery within(BusMessage message, long incarnation, long nowNanos) {
        return new MessageDelivery(message, incarnation, nowNanos, 0, Long.MAX_VALUE);
    }

    MessageDelivery withSharedLimit() {
        return new MessageDelivery(message, incarnation, arrivedNanos, ageNanos, limitNanos, true);
    }

    /** The time that is left of the limit; zero if it is over. */
    Duration left(long nowNanos) {
        return arrivedNanos == NOT_NOTED
                ? Duration.ofNanos(limitNanos)
                : Duration.ofNanos(Math.max(0, limitNanos - (nowNanos - arrivedNanos)));
    }

    /** The age of the message now; without the time since its arrival if that is not known. */
    long ageNanos(long nowNanos) {
        return arrivedNanos == NOT_NOTED ? ageNanos : ageNanos + (nowNanos - arrivedNanos);
    }

    /** True if the requester does not wait any more. */
    boolean isOverdue(long nowNanos) {
        return limitNanos != Long.MAX_VALUE && nowNanos - arrivedNanos > limitNanos;
    }

    /** Identifies a request, also among those of earlier lives of its node. */
    RequestId id() {
        return new RequestId(message.from(), incarnation, message.sequence());
    }

    /** A requester, the life of its node, and the number of the request. */
    record RequestId(Address by, long incarnation, long number) {}
}
