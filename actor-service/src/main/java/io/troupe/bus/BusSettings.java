package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Settings;
import java.util.Objects;

/**
 * Settings of a node of a bus.
 *
 * {@snippet :
 * var settings = BusSettings.on(space).withCapacity(2).withObserver(loss -> show(loss));
 * Bus bus = Bus.inProcess("house", settings);
 * }
 */
public final class BusSettings extends Settings<BusSettings> {
    private final ActorSpace space;
    private int capacity = 1_024;
    private BusObserver observer = BusObserver.logging();

    private BusSettings(ActorSpace space) {
        this.space = space;
    }

    /**
     * Settings with a capacity of 1024 messages, and losses logged.
     *
     * @param space runs the subscribers, request handlers and time limits of code that registers or asks from outside
     *     every actor space; the bus does not close it
     */
    public static BusSettings on(ActorSpace space) {
        return new BusSettings(Objects.requireNonNull(space, "space"));
    }

    @Override
    protected void check() {
        if (capacity < 1) {
            throw new IllegalArgumentException("capacity is " + capacity + " messages, expected 1 or more");
        }
    }

    /**
     * The number of messages that may be queued for one subscriber or one request handler, and the number of requests
     * that a handler may have begun without a reply. Requests that were cancelled, or whose limit is over, do not
     * count. One more value drops the oldest one; one more request is rejected.
     */
    public BusSettings withCapacity(int messages) {
        return with(copy -> copy.capacity = messages);
    }

    /** Is notified of losses; by default they are logged. */
    public BusSettings withObserver(BusObserver newObserver) {
        Objects.requireNonNull(newObserver, "observer");
        return with(copy -> copy.observer = newObserver);
    }

    public ActorSpace space() {
        return space;
    }

    public int capacity() {
        return capacity;
    }

    public BusObserver observer() {
        return observer;
    }
}
