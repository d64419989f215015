package io.troupe.faults.node;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.faults.history.Event.Executed;
import io.troupe.faults.history.History;
import java.time.Duration;

/** The actor that each node offers; every call has a name. */
interface Tool {
    /** Returns at once how many calls have been executed. */
    Promise<Long> count(String call);

    /** The same, after a while. */
    Promise<Long> countLater(String call, long millis);

    void note(String call);

    /** Sends the numbers from 1. */
    void list(String call, long items, Callback<Long> reader);

    /** Writes down what it executes. */
    final class ToolActor extends Actor implements Tool {
        private static final int BATCH = 20;
        private static final Duration PAUSE = Duration.ofMillis(20);

        private final History.Writer history;
        private long executed;

        ToolActor(History.Writer history) {
            this.history = history;
        }

        @Override
        public Promise<Long> count(String call) {
            history.add(new Executed(call));
            return Promise.of(++executed);
        }

        @Override
        public Promise<Long> countLater(String call, long millis) {
            long number = ++executed;
            history.add(new Executed(call));
            return context().space().delay(Duration.ofMillis(millis)).thenApply(nothing -> number);
        }

        @Override
        public void note(String call) {
            executed++;
            history.add(new Executed(call));
        }

        @Override
        public void list(String call, long items, Callback<Long> reader) {
            send(1, items, reader);
        }

        private void send(long first, long items, Callback<Long> reader) {
            long next = first;
            while (next <= items && next < first + BATCH && !reader.isCancelled()) {
                reader.next(next++);
            }
            if (next > items) {
                reader.finish();
            } else if (!reader.isCancelled()) {
                long rest = next;
                context().space().delay(PAUSE).thenRun(() -> send(rest, items, reader));
            }
        }
    }
}
