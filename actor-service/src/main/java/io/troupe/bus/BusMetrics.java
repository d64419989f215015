package io.troupe.bus;

/**
 * Message counts of one node of a bus since it was opened.
 *
 * {@snippet :
 * show(bus.metrics().dropped());
 * }
 *
 * <p><b>Units and shapes.</b> When no message is queued and no request is pending, {@code queued = delivered + failed +
 * dropped + droppedAtEnd + replaced + stale}, and {@code asked = answered + rejected + timedOut}, unless a requester
 * has cancelled.
 *
 * @param published values published from this node
 * @param queued values queued for subscribers on this node: one for each value and subscriber
 * @param delivered values that subscribers received
 * @param failed values whose subscriber threw an exception
 * @param dropped values removed from a full queue to make room for newer ones
 * @param droppedAtEnd values still queued when their subscription ended
 * @param undeliverable messages that could not be sent, or that no port on this node accepts
 * @param asked requests sent from this node
 * @param answered requests from this node that were fulfilled by a reply
 * @param rejected requests from this node that were rejected for another reason than their time limit
 * @param timedOut requests from this node that got no reply within their limit
 * @param late replies that arrived when their request was no longer pending
 * @param replaced values replaced by a newer one before their subscriber received them, on topics that keep only the
 *     latest
 * @param stale values dropped because they were older than their topic permits
 * @param missed values of publishers on other nodes that have not arrived
 * @param unreadable frames from other nodes that could not be read
 */
public record BusMetrics(
        long published,
        long queued,
        long delivered,
        long failed,
        long dropped,
        long droppedAtEnd,
        long undeliverable,
        long asked,
        long answered,
        long rejected,
        long timedOut,
        long late,
        long replaced,
        long stale,
        long missed,
        long unreadable) {}
