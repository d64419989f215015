package io.troupe.actor.soak;

import io.troupe.actor.promise.Promise;
import java.util.List;

/** Receives numbered messages. Each producer has separate numbers, from 0. */
interface Sink {
    void take(int producer, long number);

    /** The number of messages of a producer that have arrived. */
    Promise<Long> taken(int producer);

    /** The number of messages that have arrived from all producers. */
    Promise<Long> takenInAll();

    /** Descriptions of the first few messages that were lost, duplicated or out of order. */
    Promise<List<String>> faults();
}
