package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.SplittableRandom;
import java.util.concurrent.CancellationException;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;

/** Time limits, delays and retries that race with answers. */
final class TimerRaces {
    private static final int ASKERS = 3;
    private static final int QUESTIONS = 60;

    private TimerRaces() {}

    interface Answerer {
        Promise<Integer> answer(int value, int afterMicros);

        Promise<Integer> refuse(int value);
    }

    private static final class Answering extends Actor implements Answerer {
        @Override
        public Promise<Integer> answer(int value, int afterMicros) {
            if (afterMicros == 0) {
                return Promise.of(value);
            }
            var later = new Deferred<Integer>();
            after(micros(afterMicros), () -> later.resolve(value));
            return later;
        }

        @Override
        public Promise<Integer> refuse(int value) {
            return Promise.failed(new IllegalArgumentException("no " + value));
        }
    }

    /** One promise, and the number of calls of its listener. */
    private record Watched(Promise<?> promise, AtomicInteger calls, Promise<?> follower) {
        static Watched of(Promise<?> promise) {
            var calls = new AtomicInteger();
            return new Watched(promise, calls, promise.handle((value, error) -> calls.incrementAndGet()));
        }
    }

    private static Duration micros(long micros) {
        return Duration.ofNanos(1_000 * micros);
    }

    static void play(Round round) throws Exception {
        var space = round.space("answers");
        var other = round.space("asks");
        Answerer answerer = space.spawn(Answerer.class, Answering::new);
        var watched = new ConcurrentLinkedQueue<Watched>();
        // a timer holds a rejection for a second if another thread may still register a listener: not in every round
        boolean early = round.random.nextInt(8) == 0;
        round.start(ASKERS, (number, random) -> {
            for (int i = 0; i < QUESTIONS; i++) {
                int value = i;
                var own = random.split();
                var here = number == 0 ? other : space;
                Runnable task = () -> ask(here, early || number == 1, answerer, value, own, watched);
                if (number < 2) {
                    here.execute(task);
                } else {
                    task.run();
                }
                Round.pause(random);
            }
        });
        round.join();
        for (var each : List.of(space, other)) {
            assertThat(Round.get(each.sequential(() -> true))).isTrue();
        }
        for (var each : watched) {
            Round.settled(each.promise);
            Round.settled(each.follower);
        }
        for (var each : List.of(space, other)) {
            Round.until("no timer of " + each + " is set", () -> each.metrics().timers() == 0);
        }
        round.end();
        assertThat(watched).hasSize(ASKERS * QUESTIONS);
        for (var each : watched) {
            assertThat(each.calls.get()).as(each.toString()).isEqualTo(1);
            assertThat(each.promise.error())
                    .satisfiesAnyOf(
                            error -> assertThat(error).isNull(),
                            error -> assertThat(error).isInstanceOf(TimeoutException.class),
                            error -> assertThat(error).isInstanceOf(IllegalArgumentException.class),
                            error -> assertThat(error).isInstanceOf(CancellationException.class));
        }
        assertThat(round.leftovers(space).timers()).isZero();
        assertThat(round.leftovers(other).timers()).isZero();
    }

    /**
     * Makes a request.
     *
     * @param early true if it may be rejected before its listener is registered
     */
    private static void ask(
            ActorSpace here,
            boolean early,
            Answerer answerer,
            int value,
            SplittableRandom random,
            Queue<Watched> watched) {
        var limit = micros((early ? 0 : 300) + random.nextInt(800));
        int pauseMicros = random.nextInt(400);
        switch (random.nextInt(5)) {
            case 0 -> watched.add(Watched.of(answerer.answer(value, 0).orTimeout(limit)));
            case 1 ->
                watched.add(Watched.of(
                        answerer.answer(value, 1 + random.nextInt(800)).orTimeout(limit)));
            case 2 -> {
                var delay = here.delay(limit);
                watched.add(Watched.of(delay));
                if (random.nextBoolean()) {
                    delay.cancel();
                }
            }
            case 3 -> {
                var tries = new AtomicInteger(early ? random.nextInt(4) : 0);
                var retried = here.retry(
                        3,
                        micros(pauseMicros),
                        () -> tries.getAndDecrement() > 0 ? answerer.refuse(value) : answerer.answer(value, 0));
                watched.add(Watched.of(retried));
                if (random.nextInt(3) == 0) {
                    Round.pause(random);
                    retried.cancel();
                }
            }
            default -> {
                var stages = new ArrayList<Promise<Integer>>();
                stages.add(answerer.answer(value, random.nextInt(300)).orTimeout(Duration.ofHours(1)));
                stages.add(stages.getFirst().orTimeout(limit));
                watched.add(Watched.of(stages.getLast()));
                if (random.nextBoolean()) {
                    Round.pause(random);
                    stages.get(random.nextInt(2)).cancel();
                }
            }
        }
    }
}
