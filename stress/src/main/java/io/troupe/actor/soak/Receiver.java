package io.troupe.actor.soak;

import io.troupe.actor.promise.Promise;
import java.util.ArrayList;
import java.util.List;

/** Checks that every producer's numbers are consecutive. */
final class Receiver implements Sink {
    private static final int FAULTS_KEPT = 10;

    private final String name;
    private final long[] taken;
    private final List<String> faults = new ArrayList<>();
    private long takenInAll;

    Receiver(String name, int producers) {
        this.name = name;
        this.taken = new long[producers];
    }

    @Override
    public void take(int producer, long number) {
        long expected = taken[producer];
        if (number != expected && faults.size() < FAULTS_KEPT) {
            faults.add("%s: message %,d of producer %d came where %,d was expected"
                    .formatted(name, number, producer, expected));
        }
        taken[producer] = number + 1;
        takenInAll++;
    }

    @Override
    public Promise<Long> taken(int producer) {
        return Promise.of(taken[producer]);
    }

    @Override
    public Promise<Long> takenInAll() {
        return Promise.of(takenInAll);
    }

    @Override
    public Promise<List<String>> faults() {
        return Promise.of(List.copyOf(faults));
    }
}
