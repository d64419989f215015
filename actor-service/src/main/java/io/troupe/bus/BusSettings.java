package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import java.util.Objects;

/**
 * Settings of a node of a bus; immutable.
 *
 * {@snippet :
 * var settings = BusSettings.on(space).withCapacity(2).withObserver(loss -> show(loss));
 * Bus bus = Bus.inProcess("house", settings);
 * }
 *
 * @param space runs the subscribers, request handlers and time limits of code that registers or asks from outside every
 *     actor space; the bus does not close it
 * @param capacity the most messages queued for one subscriber or one request handler, and the most requests that a
 *     handler may have begun without a reply. Requests that were cancelled, or whose limit is over, do not count; one
 *     more request is rejected
 * @param observer is notified of losses
 */
public record BusSettings(ActorSpace space, int capacity, BusObserver observer) {
    private static final int USUAL_CAPACITY = 1024;

    public BusSettings {
        Objects.requireNonNull(space, "space");
        Objects.requireNonNull(observer, "observer");
        if (capacity < 1) {
            throw new IllegalArgumentException("capacity is " + capacity + " messages, expected 1 or more");
        }
    }

    /** Settings with that space for code outside every actor space, a capacity of 1024 messages, and losses logged. */
    public static BusSettings on(ActorSpace space) {
        return new BusSettings(space, USUAL_CAPACITY, BusObserver.logging());
    }

    public BusSettings withCapacity(int messages) {
        return new BusSettings(space, messages, observer);
    }

    public BusSettings withObserver(BusObserver newObserver) {
        return new BusSettings(space, capacity, newObserver);
    }
}
