package io.troupe.actor.soak;

import io.troupe.actor.promise.Promise;
import java.util.List;

/** Forwards every message to an actor in another space. */
final class Forwarder implements Sink {
    private final Sink target;

    Forwarder(Sink target) {
        this.target = target;
    }

    @Override
    public void take(int producer, long number) {
        target.take(producer, number);
    }

    @Override
    public Promise<Long> taken(int producer) {
        return target.taken(producer);
    }

    @Override
    public Promise<Long> takenInAll() {
        return target.takenInAll();
    }

    @Override
    public Promise<List<String>> faults() {
        return target.faults();
    }
}
