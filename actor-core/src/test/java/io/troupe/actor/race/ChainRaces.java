package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Supervision;
import io.troupe.actor.promise.Promise;
import java.util.Queue;
import java.util.SplittableRandom;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicReference;

/** Requests that go back and forth between spaces and threads. */
final class ChainRaces {
    private static final int THREADS = 3;
    private static final int DEEPEST = 6;

    private ChainRaces() {}

    interface Link {
        /**
         * The depth, counted by the actors of the chain; each digit of {@code manner} selects how one of them answers.
         */
        Promise<Integer> count(int depth, int manner);

        void end();
    }

    private static final class Linked extends Actor implements Link {
        private final AtomicReference<Link> next;
        private final Queue<Promise<?>> promises;

        Linked(AtomicReference<Link> next, Queue<Promise<?>> promises) {
            this.next = next;
            this.promises = promises;
        }

        @Override
        public Promise<Integer> count(int depth, int manner) {
            if (depth == 0) {
                return Promise.of(0);
            }
            return seen(
                    switch (manner & 3) {
                        case 0 -> ask(depth, manner).thenApply(below -> below + 1);
                        case 1 -> ask(depth, manner).thenCompose(below -> seen(Promise.of(below + 1)));
                        case 2 -> space().sequential(() -> ask(depth, manner).await() + 1);
                        default -> space().sequential(() -> 1 + nested(depth, manner));
                    });
        }

        private int nested(int depth, int manner) {
            Promise<Integer> inner =
                    seen(space().sequential(() -> ask(depth, manner).await()));
            return inner.await();
        }

        private Promise<Integer> ask(int depth, int manner) {
            return seen(next.get().count(depth - 1, manner >>> 2));
        }

        private <P extends Promise<?>> P seen(P promise) {
            promises.add(promise);
            return promise;
        }

        @Override
        public void end() {
            throw new IllegalStateException("on purpose");
        }
    }

    static void chains(Round round) throws Exception {
        var promises = new ConcurrentLinkedQueue<Promise<?>>();
        var first = round.space("first");
        var second = round.space("second");
        var toFirst = new AtomicReference<Link>();
        var toSecond = new AtomicReference<Link>();
        var settings = ActorSettings.DEFAULT.withSupervision(
                round.random.nextBoolean()
                        ? Supervision.STOP
                        : Supervision.restart(1_000, java.time.Duration.ofHours(1)));
        toFirst.set(first.spawn(Link.class, () -> new Linked(toSecond, promises), settings));
        toSecond.set(second.spawn(Link.class, () -> new Linked(toFirst, promises), settings));
        int disturbance = round.random.nextInt(4);
        boolean cancels = round.random.nextBoolean();
        round.start(THREADS, (number, random) -> {
            for (int i = 0; i < 20; i++) {
                int depth = random.nextInt(DEEPEST + 1);
                var link = random.nextBoolean() ? toFirst.get() : toSecond.get();
                var counted = link.count(depth, random.nextInt());
                promises.add(counted);
                promises.add(counted.thenAccept(value -> {
                    if (value != depth) {
                        round.wrong.add(value + " instead of " + depth);
                    }
                }));
                Round.pause(random);
                if (cancels && random.nextInt(3) == 0) {
                    counted.cancel();
                }
                if (number == 0 && i == 10) {
                    disturb(disturbance, first, second, toFirst.get());
                }
            }
        });
        round.join();
        boolean undisturbed = disturbance == 0 && !cancels;
        if (undisturbed) {
            for (var promise : promises) {
                assertThat(Round.settled(promise).error()).isNull();
            }
        }
        round.end();
        for (var promise : promises) {
            Round.settled(promise);
        }
        if (undisturbed) {
            assertThat(round.leftovers(first).isEmpty()).isTrue();
            assertThat(round.leftovers(second).sequences()).isZero();
        }
    }

    private static void disturb(int how, ActorSpace first, ActorSpace second, Link link) {
        switch (how) {
            case 1 -> link.end();
            case 2 -> first.stop(link);
            case 3 -> second.execute(first::close);
            default -> {}
        }
    }

    /** A request reaches a space that is asleep, and one that is about to sleep. */
    static void silence(Round round) throws Exception {
        var near = round.space("near");
        var far = round.space("far");
        var echo = new AtomicReference<Link>();
        var relay = new AtomicReference<Link>();
        var promises = new ConcurrentLinkedQueue<Promise<?>>();
        echo.set(far.spawn(Link.class, () -> new Linked(relay, promises)));
        relay.set(near.spawn(Link.class, () -> new Linked(echo, promises)));
        round.start(2, (number, random) -> {
            for (int i = 0; i < 60; i++) {
                awaitSilence(random);
                var link = random.nextBoolean() ? relay.get() : echo.get();
                int depth = random.nextInt(3);
                var answer = link.count(depth, random.nextInt());
                assertThat(Round.get(random.nextBoolean() ? answer : answer.thenApply(value -> value)))
                        .isEqualTo(depth);
            }
        });
        round.join();
        round.end();
        assertThat(promises).allMatch(Promise::isDone);
        assertThat(round.leftovers(near).isEmpty()).isTrue();
        assertThat(round.errors).isEmpty();
    }

    private static void awaitSilence(SplittableRandom random) {
        for (int i = random.nextInt(4); i > 0; i--) {
            Round.pause(random);
        }
    }
}
