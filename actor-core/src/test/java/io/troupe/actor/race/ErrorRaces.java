package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.Promise;
import io.troupe.actor.Supervision;
import java.time.Duration;
import java.util.Collections;
import java.util.HashSet;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Set;
import java.util.SplittableRandom;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;

/** Errors of the virtual machine in callers and actors, while other actors run. */
final class ErrorRaces {
    private static final int CALLS = 100;
    private static final int DEEP_CALLS = 2;
    private static final int SMALL_STACK_BYTES = 200_000;

    private ErrorRaces() {}

    interface Counter {
        void add();

        Promise<Integer> count();
    }

    private static final class Counting implements Counter {
        private int count;

        @Override
        public void add() {
            count++;
        }

        @Override
        public Promise<Integer> count() {
            return Promise.of(count);
        }
    }

    /** Calls where its stack is exhausted, and from each frame further up until a call returns. */
    private static final class Deep implements Runnable {
        private final Runnable call;
        private boolean returned;
        private int tries;

        Deep(Runnable call) {
            this.call = call;
        }

        @Override
        public void run() {
            try {
                run();
            } catch (StackOverflowError end) {
                if (!returned) {
                    tries++;
                    call.run();
                    returned = true;
                }
            }
        }
    }

    static void endOfTheStack(Round round) throws Exception {
        var space = round.space("deep");
        var second = round.space("asks");
        Counter counter = space.spawn(Counter.class, Counting::new);
        for (var warm : List.of(space, second)) { // a class first used where the stack is exhausted is never linked
            warm.execute(counter::add);
            assertThat(Round.get(warm.sequential(() -> counter.count().await())))
                    .isPositive();
        }
        counter.add();
        int before = Round.get(counter.count());
        var least = new AtomicInteger(before);
        var most = new AtomicInteger(before);
        var asked = new ConcurrentLinkedQueue<Promise<Integer>>();
        round.run(3, (number, random) -> {
            if (number == 0) {
                for (int i = 0; i < DEEP_CALLS; i++) {
                    var deep = new Deep(counter::add);
                    var thread = new Thread(null, deep, "deep", SMALL_STACK_BYTES);
                    thread.setDaemon(true);
                    thread.start();
                    thread.join();
                    least.addAndGet(deep.returned ? 1 : 0);
                    most.addAndGet(deep.tries);
                    Round.pause(random);
                }
                return;
            }
            for (int i = 0; i < CALLS; i++) {
                if (number == 1) {
                    counter.add();
                } else {
                    second.execute(counter::add);
                }
                asked.add(counter.count());
                least.incrementAndGet();
                most.incrementAndGet();
                Round.pause(random);
            }
        });
        Round.drain(List.of(second));
        for (var each : asked) {
            assertThat(Round.settled(each).error()).isNull();
        }
        assertThat(Round.get(counter.count())).isBetween(least.get(), most.get());
        round.end();
        assertThat(round.leftovers(space).isEmpty()).isTrue();
        assertThat(round.errors).isEmpty();
    }

    static class Broken extends Actor {
        private int depth;

        public void breakMessage(Error error) {
            throw error;
        }

        public void breakTimer(Error error) {
            context().after(Duration.ZERO, () -> {
                throw error;
            });
        }

        public Promise<Integer> breakRequest(Error error) {
            throw error;
        }

        public void overflow() {
            depth++;
            overflow();
        }
    }

    private static Error error(SplittableRandom random) {
        return switch (random.nextInt(3)) {
            case 0 -> new OutOfMemoryError("on purpose");
            case 1 -> new InternalError("on purpose");
            default -> new StackOverflowError("on purpose");
        };
    }

    static void fatalErrors(Round round) throws Exception {
        var space = round.space("broken");
        boolean restarts = round.random.nextBoolean();
        var supervision = restarts ? Supervision.restart(1_000_000, Duration.ofHours(1)) : Supervision.RESUME;
        var settings = ActorSettings.defaults().withSupervision(supervision);
        Broken broken = space.spawn(Broken.class, Broken::new, settings);
        Counter steady = space.spawn(Counter.class, Counting::new);
        var thrown = new ConcurrentLinkedQueue<Error>();
        var asked = new ConcurrentLinkedQueue<Promise<?>>();
        var overflows = new AtomicInteger();
        round.run(3, (number, random) -> {
            for (int i = 0; i < CALLS; i++) {
                if (number == 0) {
                    steady.add();
                    continue;
                }
                var error = error(random);
                switch (random.nextInt(4)) {
                    case 0 -> {
                        thrown.add(error);
                        broken.breakMessage(error);
                    }
                    case 1 -> {
                        if (!restarts) { // a restart cancels timers
                            thrown.add(error);
                            broken.breakTimer(error);
                        }
                    }
                    case 2 -> asked.add(broken.breakRequest(error).handle((value, with) -> with));
                    default -> {
                        var failing = steady.count().thenAccept(value -> {
                            throw error;
                        });
                        asked.add(failing.handle((value, with) -> with));
                    }
                }
                if (random.nextInt(20) == 0) {
                    overflows.incrementAndGet();
                    broken.overflow();
                }
            }
        });
        for (var each : asked) {
            assertThat(Round.settled(each).getNow()).isInstanceOf(Error.class);
        }
        assertThat(Round.get(steady.count())).isEqualTo(CALLS);
        Round.until("all errors are reported", () -> new HashSet<>(round.errors).containsAll(thrown));
        round.end();
        Set<Throwable> reported = Collections.newSetFromMap(new IdentityHashMap<>());
        reported.addAll(round.errors);
        assertThat(reported).as("each error is reported once").hasSameSizeAs(round.errors);
        assertThat(reported).as("errors of messages and timers").containsAll(thrown);
        assertThat(round.errors)
                .as("stacks that ended")
                .filteredOn(error -> error instanceof StackOverflowError && error.getMessage() == null)
                .hasSize(overflows.get());
    }
}
