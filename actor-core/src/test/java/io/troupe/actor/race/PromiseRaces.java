package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;

/** Promises that several threads settle, cancel and register listeners with concurrently. */
final class PromiseRaces {
    private static final int THREADS = 3;
    private static final int PROMISES = 40;
    private static final int LISTENERS = 4;

    private PromiseRaces() {}

    private record Call(int thread, int number) {}

    private static final class Trial {
        final Deferred<Integer> promise;
        final boolean atHome;
        final AtomicInteger settled = new AtomicInteger();
        final Queue<Call> calls = new ConcurrentLinkedQueue<>();
        final Queue<@Nullable Object> outcomes = new ConcurrentLinkedQueue<>();
        final Queue<Promise<?>> followers = new ConcurrentLinkedQueue<>();
        final AtomicInteger[] ofCancelled = {new AtomicInteger(), new AtomicInteger(), new AtomicInteger()};

        Trial(@Nullable ActorSpace home) {
            this.promise = new Deferred<>(home);
            this.atHome = home != null;
        }

        void listen(int thread, int number) {
            followers.add(promise.whenComplete((value, error) -> {
                calls.add(new Call(thread, number));
                outcomes.add(error != null ? error : String.valueOf(value));
            }));
        }

        void listenAndCancel(int thread) {
            Promise<?> follower = promise.whenComplete((value, error) -> ofCancelled[thread].incrementAndGet());
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
            for (var count : ofCancelled) {
                assertThat(count.get())
                        .as("calls of a listener that was cancelled")
                        .isBetween(0, 1);
            }
            if (atHome || fromOneSpaceEach) {
                for (int thread = 0; thread < THREADS; thread++) {
                    int wanted = thread;
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
        var trials = new ArrayList<Trial>();
        for (int i = 0; i < PROMISES; i++) {
            trials.add(new Trial(round.random.nextInt(3) > 0 ? home : null));
        }
        round.start(THREADS, (thread, random) -> {
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
        round.join();
        for (var space : spaces) { // so that all have registered before any space is closed
            assertThat(Round.get(space.sequential(() -> true))).isTrue();
        }
        for (var trial : trials) {
            for (var follower : trial.followers) {
                Round.settled(follower);
            }
        }
        round.end();
        for (var trial : trials) {
            trial.check(inside);
        }
    }
}
