package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Supervision;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.Collections;
import java.util.HashSet;
import java.util.IdentityHashMap;
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

        private void recurse() {
            try {
                recurse();
            } catch (StackOverflowError end) {
                if (!returned) {
                    tries++;
                    call.run();
                    returned = true;
                }
            }
        }

        @Override
        public void run() {
            recurse();
        }
    }

    static void endOfTheStack(Round round) throws Exception {
        var space = round.space("deep");
        var second = round.space("asks");
        Counter counter = space.spawn(Counter.class, Counting::new);
        for (var warm : new ActorSpace[] {space, second
        }) { // a class that is first used where the stack is exhausted is never linked
            warm.execute(counter::add);
            assertThat(Round.get(warm.sequential(() -> counter.count().await())))
                    .isPositive();
        }
        counter.add();
        int before = Round.get(counter.count());
        var least = new AtomicInteger(before);
        var most = new AtomicInteger(before);
        var asked = new ConcurrentLinkedQueue<Promise<Integer>>();
        round.start(3, (number, random) -> {
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
            } else {
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
            }
        });
        round.join();
        Round.get(second.sequential(() -> true));
        for (var each : asked) {
            assertThat(Round.settled(each).error()).isNull();
        }
        assertThat(Round.get(counter.count())).isBetween(least.get(), most.get());
        round.end();
        assertThat(round.leftovers(space).isEmpty()).isTrue();
        assertThat(round.errors).isEmpty();
    }

    /** What throws the error. */
    private enum By {
        MESSAGE,
        TIMER,
        REQUEST,
        LISTENER
    }

    interface Breaking {
        void breakMessage(Error error);

        void breakTimer(Error error);

        Promise<Integer> breakRequest(Error error);

        void overflow();
    }

    private static final class Broken extends Actor implements Breaking {
        private int depth;

        @Override
        public void breakMessage(Error error) {
            throw error;
        }

        @Override
        public void breakTimer(Error error) {
            after(Duration.ZERO, () -> {
                throw error;
            });
        }

        @Override
        public Promise<Integer> breakRequest(Error error) {
            throw error;
        }

        @Override
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
        Breaking broken = space.spawn(
                Breaking.class,
                Broken::new,
                ActorSettings.DEFAULT.withSupervision(
                        restarts ? Supervision.restart(1_000_000, Duration.ofHours(1)) : Supervision.RESUME));
        Counter steady = space.spawn(Counter.class, Counting::new);
        var thrown = new ConcurrentLinkedQueue<Error>();
        var asked = new ConcurrentLinkedQueue<Promise<?>>();
        var overflows = new AtomicInteger();
        round.start(3, (number, random) -> {
            for (int i = 0; i < CALLS; i++) {
                if (number == 0) {
                    steady.add();
                    continue;
                }
                var error = error(random);
                switch (By.values()[random.nextInt(4)]) {
                    case MESSAGE -> {
                        thrown.add(error);
                        broken.breakMessage(error);
                    }
                    case TIMER -> {
                        if (!restarts) { // a restart cancels timers
                            thrown.add(error);
                            broken.breakTimer(error);
                        }
                    }
                    case REQUEST -> asked.add(broken.breakRequest(error).handle((value, with) -> with));
                    case LISTENER ->
                        asked.add(steady.count()
                                .thenAccept(value -> {
                                    throw error;
                                })
                                .handle((value, with) -> with));
                }
                if (random.nextInt(20) == 0) {
                    overflows.incrementAndGet();
                    broken.overflow();
                }
            }
        });
        round.join();
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
        long real = round.errors.stream()
                .filter(error -> error instanceof StackOverflowError && error.getMessage() == null)
                .count();
        assertThat(real).as("stacks that ended").isEqualTo(overflows.get());
    }
}
