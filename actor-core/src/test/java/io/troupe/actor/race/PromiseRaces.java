package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import java.time.Duration;
import java.util.List;
import java.util.Queue;
import java.util.SplittableRandom;
import java.util.concurrent.CancellationException;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicIntegerArray;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/** Promises that several threads, time limits, delays and retries settle, cancel and listen to concurrently. */
final class PromiseRaces {
    private static final int THREADS = 3;
    private static final int PROMISES = 40;
    private static final int LISTENERS = 4;
    private static final int QUESTIONS = 60;

    private PromiseRaces() {}

    private record Call(int thread, int number) {}

    private static final class Trial {
        final Deferred<Integer> promise;
        final boolean atHome;
        final AtomicInteger settled = new AtomicInteger();
        final Queue<Call> calls = new ConcurrentLinkedQueue<>();
        final Queue<@Nullable Object> outcomes = new ConcurrentLinkedQueue<>();
        final Queue<Promise<?>> followers = new ConcurrentLinkedQueue<>();
        final AtomicIntegerArray ofCancelled = new AtomicIntegerArray(THREADS);

        Trial(@Nullable ActorSpace home) {
            this.promise = home == null ? Deferred.unbound() : home.deferred();
            this.atHome = home != null;
        }

        void listen(int thread, int number) {
            followers.add(promise.whenComplete((value, error) -> {
                calls.add(new Call(thread, number));
                outcomes.add(error != null ? error : String.valueOf(value));
            }));
        }

        void listenAndCancel(int thread) {
            Promise<?> follower = promise.whenComplete((value, error) -> ofCancelled.incrementAndGet(thread));
            follower.cancel();
            followers.add(follower);
        }

        void settle(int how, int thread) {
            boolean first = switch (how) {
                case 0 -> promise.resolve(thread);
                case 1 -> promise.reject(new IllegalStateException("rejected by " + thread));
                default -> promise.cancel();
            };
            if (first) {
                settled.incrementAndGet();
            }
        }

        void check(boolean fromOneSpaceEach) {
            assertThat(promise.isDone()).isTrue();
            assertThat(settled.get()).as("how often it was settled").isEqualTo(1);
            assertThat(calls)
                    .as("calls of listeners")
                    .hasSize(THREADS * LISTENERS)
                    .doesNotHaveDuplicates();
            assertThat(outcomes).containsOnly(outcomes.peek());
            for (int thread = 0; thread < THREADS; thread++) {
                int wanted = thread;
                assertThat(ofCancelled.get(thread))
                        .as("calls of a cancelled listener")
                        .isBetween(0, 1);
                if (atHome || fromOneSpaceEach) {
                    assertThat(calls.stream()
                                    .filter(call -> call.thread == wanted)
                                    .map(Call::number))
                            .as("order of thread " + thread)
                            .containsExactly(0, 1, 2, 3);
                }
            }
        }
    }

    static void listeners(Round round) throws Exception {
        ActorSpace home = round.space("home");
        var spaces = List.of(round.space("first"), round.space("second"), home);
        boolean inside = round.random.nextBoolean();
        var trials = IntStream.range(0, PROMISES)
                .mapToObj(i -> new Trial(round.random.nextInt(3) > 0 ? home : null))
                .toList();
        round.run(THREADS, (thread, random) -> {
            for (var trial : trials) {
                int settleAfter = random.nextInt(LISTENERS + 1);
                int how = random.nextInt(3);
                boolean cancels = random.nextBoolean();
                Runnable task = () -> {
                    for (int number = 0; number <= LISTENERS; number++) {
                        if (number == settleAfter) {
                            trial.settle(how, thread);
                        }
                        if (number < LISTENERS) {
                            trial.listen(thread, number);
                        }
                    }
                    if (cancels) {
                        trial.listenAndCancel(thread);
                    }
                };
                if (inside) {
                    spaces.get(thread).execute(task);
                } else {
                    task.run();
                }
                Round.pause(random);
            }
        });
        Round.drain(spaces); // so that all have registered before any space is closed
        for (var trial : trials) {
            for (var follower : trial.followers) {
                Round.settled(follower);
            }
        }
        round.end();
        trials.forEach(trial -> trial.check(inside));
    }

    // ---- time limits, delays and retries that race with answers

    static class Answerer extends Actor {
        public Promise<Integer> answer(int value, int afterMicros) {
            if (afterMicros == 0) {
                return Promise.of(value);
            }
            var later = new Deferred<Integer>();
            context().after(micros(afterMicros), () -> later.resolve(value));
            return later;
        }

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

    static void timeLimits(Round round) throws Exception {
        var space = round.space("answers");
        var other = round.space("asks");
        var spaces = List.of(space, other);
        Answerer answerer = space.spawn(Answerer.class, Answerer::new);
        var watched = new ConcurrentLinkedQueue<Watched>();
        // a timer holds a rejection for a second if another thread may still register a listener: not in every round
        boolean early = round.random.nextInt(8) == 0;
        round.run(THREADS, (number, random) -> {
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
        Round.drain(spaces);
        for (var each : watched) {
            Round.settled(each.promise);
            Round.settled(each.follower);
        }
        for (var each : spaces) {
            Round.until("no timer of " + each + " is set", () -> each.metrics().timers() == 0);
        }
        round.end();
        assertThat(watched).hasSize(THREADS * QUESTIONS);
        for (var each : watched) {
            assertThat(each.calls.get()).as(each.toString()).isEqualTo(1);
            if (each.promise.error() != null) {
                assertThat(each.promise.error())
                        .isInstanceOfAny(
                                TimeoutException.class, IllegalArgumentException.class, CancellationException.class);
            }
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
            case 1 -> {
                var answer = answerer.answer(value, 1 + random.nextInt(800));
                watched.add(Watched.of(answer.orTimeout(limit)));
            }
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
                var first = answerer.answer(value, random.nextInt(300)).orTimeout(Duration.ofHours(1));
                var second = first.orTimeout(limit);
                watched.add(Watched.of(second));
                if (random.nextBoolean()) {
                    Round.pause(random);
                    (random.nextBoolean() ? first : second).cancel();
                }
            }
        }
    }
}
