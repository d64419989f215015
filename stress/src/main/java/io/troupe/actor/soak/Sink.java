package io.troupe.actor.soak;

import io.troupe.actor.promise.Promise;
import java.util.List;

/** Takes numbered messages. Each producer numbers its own, from 0. */
interface Sink {
    void take(int producer, long number);

    /** How many messages of a producer have arrived. */
    Promise<Long> taken(int producer);

    /** How many have arrived in all. */
    Promise<Long> takenInAll();

    /** What was lost, doubled or out of order: the first few, in words. */
    Promise<List<String>> faults();
}
