package io.troupe.bus;

import java.util.concurrent.atomic.LongAdder;

/** The message counters of a node; incremented from any thread. */
final class Counters {
    final LongAdder published = new LongAdder();
    final LongAdder queued = new LongAdder();
    final LongAdder delivered = new LongAdder();
    final LongAdder failed = new LongAdder();
    final LongAdder dropped = new LongAdder();
    final LongAdder droppedAtEnd = new LongAdder();
    final LongAdder undeliverable = new LongAdder();
    final LongAdder asked = new LongAdder();
    final LongAdder answered = new LongAdder();
    final LongAdder rejected = new LongAdder();
    final LongAdder timedOut = new LongAdder();
    final LongAdder late = new LongAdder();
    final LongAdder replaced = new LongAdder();
    final LongAdder stale = new LongAdder();
    final LongAdder missed = new LongAdder();
    final LongAdder unreadable = new LongAdder();

    BusMetrics now() {
        return new BusMetrics(
                published.sum(),
                queued.sum(),
                delivered.sum(),
                failed.sum(),
                dropped.sum(),
                droppedAtEnd.sum(),
                undeliverable.sum(),
                asked.sum(),
                answered.sum(),
                rejected.sum(),
                timedOut.sum(),
                late.sum(),
                replaced.sum(),
                stale.sum(),
                missed.sum(),
                unreadable.sum());
    }
}
