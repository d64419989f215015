package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorPool;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.Consumer;
import java.util.stream.Stream;

/** Calls of a pool whose actors stop one after the other, until none is left. */
final class PoolRaces {
    private static final int CALLERS = 3;
    private static final int CALLS = 200;

    private PoolRaces() {}

    /** Counts what it is asked. */
    interface Counter {
        Promise<Integer> next(Integer caller);

        void note();

        void report(int values, Callback<Integer> reader);
    }

    private record Member(LongAdder handled, LongAdder noted) implements Counter {
        @Override
        public Promise<Integer> next(Integer caller) {
            handled.increment();
            return Promise.of(caller);
        }

        @Override
        public void note() {
            noted.increment();
        }

        @Override
        public void report(int values, Callback<Integer> reader) {
            for (int value = 0; value < values; value++) {
                reader.next(value);
            }
            reader.finish();
        }
    }

    /** One call of a broadcast: what its callback received. */
    private record Reports(AtomicInteger values, AtomicInteger ends, AtomicInteger failures) {
        Reports() {
            this(new AtomicInteger(), new AtomicInteger(), new AtomicInteger());
        }

        Callback<Integer> reader() {
            return new Callback.Stream<>(value -> values.incrementAndGet(), end -> {
                ends.incrementAndGet();
                if (end != null) {
                    failures.incrementAndGet();
                }
            });
        }
    }

    static void stoppingMembers(Round round) throws Exception {
        var handled = new LongAdder();
        var noted = new LongAdder();
        var dead = new LongAdder();
        Consumer<String> onDeadLetter = mark -> {
            if (mark.contains("note")) { // a report of a broadcast is one, too, and its callback fails
                dead.increment();
            }
        };
        var spaces = Stream.of("a", "b", "c", "d")
                .map(name -> round.space(name, onDeadLetter))
                .toList();
        var pool = ActorPool.on(spaces, Counter.class, () -> new Member(handled, noted), ActorSettings.defaults());
        var answers = new ConcurrentLinkedQueue<Promise<Integer>>();
        var broadcasts = new ConcurrentLinkedQueue<Reports>();
        var notes = new LongAdder();
        round.run(CALLERS + 1, (caller, random) -> {
            if (caller == CALLERS) {
                stopAll(pool, spaces, random);
                return;
            }
            for (int number = 0; number < CALLS; number++) {
                answers.add(pool.byFirstArgument().next(caller));
                answers.add(pool.roundRobin().next(caller));
                pool.roundRobin().note();
                notes.increment();
                var reports = new Reports();
                broadcasts.add(reports);
                pool.broadcast().report(3, reports.reader());
                if (number % 8 == 0) {
                    Round.pause(random);
                }
            }
        });
        long fulfilled = 0;
        for (Promise<Integer> answer : answers) {
            if (Round.settled(answer).error() instanceof ActorStoppedException) {
                continue;
            }
            Round.get(answer); // throws any other error
            fulfilled++;
        }
        for (var each : broadcasts) {
            Round.until(
                    "the callback of a broadcast has ended", () -> each.ends().get() == 1);
        }
        Round.drain(spaces);
        round.end();
        assertThat(pool.living()).isZero();
        assertThat(answers).hasSize(2 * CALLERS * CALLS);
        assertThat(fulfilled).as("answers of requests that ran").isEqualTo(handled.sum());
        assertThat(noted.sum() + dead.sum())
                .as("messages that ran, and dead letters")
                .isEqualTo(notes.sum());
        for (var each : broadcasts) {
            assertThat(each.ends()).as("ends of a callback").hasValue(1);
            if (each.failures().get() == 0) {
                assertThat(each.values().get() % 3)
                        .as("values of complete reports")
                        .isZero();
            }
        }
        assertThat(round.errors).isEmpty();
    }

    private static void stopAll(ActorPool<Counter> pool, List<ActorSpace> spaces, SplittableRandom random)
            throws InterruptedException {
        for (int member = 0; member < spaces.size(); member++) {
            for (int pause = 0; pause < 20; pause++) {
                Round.pause(random);
            }
            Counter stopping = pool.actors().get(member);
            ActorSpace space = spaces.get(member);
            var end = space.whenStopped(stopping);
            space.stop(stopping);
            Round.settled(end);
        }
    }
}
