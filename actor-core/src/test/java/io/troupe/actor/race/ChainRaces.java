package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.Supervision;
import java.time.Duration;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicReference;

/** Requests that go back and forth between spaces and threads. */
final class ChainRaces {
    private static final int THREADS = 3;
    private static final int DEEPEST = 6;

    private final Queue<Promise<?>> promises = new ConcurrentLinkedQueue<>();
    private final AtomicReference<Link> toFirst = new AtomicReference<>();
    private final AtomicReference<Link> toSecond = new AtomicReference<>();
    private final Round round;
    private final ActorSpace first;
    private final ActorSpace second;

    ChainRaces(Round round) {
        this.round = round;
        this.first = round.space("first");
        this.second = round.space("second");
    }

    class Link extends Actor {
        private final AtomicReference<Link> next;

        Link(AtomicReference<Link> next) {
            this.next = next;
        }

        /**
         * The depth, counted by the actors of the chain; each digit of {@code manner} selects how one of them answers.
         */
        public Promise<Integer> count(int depth, int manner) {
            if (depth == 0) {
                return Promise.of(0);
            }
            return seen(
                    switch (manner & 3) {
                        case 0 -> ask(depth, manner).thenApply(below -> below + 1);
                        case 1 -> ask(depth, manner).thenCompose(below -> seen(Promise.of(below + 1)));
                        case 2 ->
                            context()
                                    .space()
                                    .sequential(() -> ask(depth, manner).await() + 1);
                        default -> context().space().sequential(() -> 1 + nested(depth, manner));
                    });
        }

        private int nested(int depth, int manner) {
            Promise<Integer> inner =
                    context().space().sequential(() -> ask(depth, manner).await());
            return seen(inner).await();
        }

        private Promise<Integer> ask(int depth, int manner) {
            return seen(next.get().count(depth - 1, manner >>> 2));
        }

        public void end() {
            throw new IllegalStateException("on purpose");
        }
    }

    private <P extends Promise<?>> P seen(P promise) {
        promises.add(promise);
        return promise;
    }

    private void spawn(ActorSettings settings) {
        toFirst.set(first.spawn(Link.class, () -> new Link(toSecond), settings));
        toSecond.set(second.spawn(Link.class, () -> new Link(toFirst), settings));
    }

    void chains() throws Exception {
        spawn(ActorSettings.defaults()
                .withSupervision(
                        round.random.nextBoolean()
                                ? Supervision.STOP
                                : Supervision.restart(1_000, Duration.ofHours(1))));
        int disturbance = round.random.nextInt(4);
        boolean cancels = round.random.nextBoolean();
        round.run(THREADS, (number, random) -> {
            for (int i = 0; i < 20; i++) {
                int depth = random.nextInt(DEEPEST + 1);
                var link = random.nextBoolean() ? toFirst.get() : toSecond.get();
                var counted = seen(link.count(depth, random.nextInt()));
                seen(counted.thenAccept(value -> {
                    if (value != depth) {
                        round.wrong.add(value + " instead of " + depth);
                    }
                }));
                Round.pause(random);
                if (cancels && random.nextInt(3) == 0) {
                    counted.cancel();
                }
                if (number == 0 && i == 10) {
                    disturb(disturbance);
                }
            }
        });
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

    private void disturb(int how) {
        switch (how) {
            case 1 -> toFirst.get().end();
            case 2 -> first.stop(toFirst.get());
            case 3 -> second.execute(first::close);
            default -> {}
        }
    }

    /** A request reaches a space that is asleep, and one that is about to sleep. */
    void silence() throws Exception {
        spawn(ActorSettings.defaults());
        round.run(2, (number, random) -> {
            for (int i = 0; i < 60; i++) {
                for (int pauses = random.nextInt(4); pauses > 0; pauses--) {
                    Round.pause(random);
                }
                var link = random.nextBoolean() ? toFirst.get() : toSecond.get();
                int depth = random.nextInt(3);
                var answer = seen(link.count(depth, random.nextInt()));
                assertThat(Round.get(random.nextBoolean() ? answer : answer.thenApply(value -> value)))
                        .isEqualTo(depth);
            }
        });
        round.end();
        assertThat(promises).isNotEmpty().allMatch(Promise::isDone);
        assertThat(round.leftovers(first).isEmpty()).isTrue();
        assertThat(round.errors).isEmpty();
    }
}
