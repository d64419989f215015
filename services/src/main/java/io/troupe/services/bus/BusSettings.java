package io.troupe.services.bus;

import io.troupe.actor.ActorSpace;
import java.util.Objects;

/**
 * How a node of a bus is made; immutable.
 *
 * @param space where those hear, answer and have their time limits who register or ask from outside every actor space;
 *     not closed by the bus
 * @param capacity how many messages wait before one subscriber, or before one answerer, at the most; an answerer may
 *     have begun as many questions that are not yet answered. One more makes the oldest of those from other nodes
 *     refused, since its asker may have given up unnoticed; if there is none, it is refused itself
 * @param observer is told what is lost
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

    /** For those who register from outside, that space; 1024 messages; losses are logged. */
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
