package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorPool;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Topic;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.LongAdder;
import org.jspecify.annotations.Nullable;

/**
 * Calls that are held back, shared among the actors of a pool, limited in time, or results of which some are skipped.
 */
final class DeliveryRaces {
    private static final int CALLERS = 3;
    private static final int CALLS = 300;

    private DeliveryRaces() {}

    // ---- actors of a pool that hold their calls back

    /** Receives the numbers of its callers. */
    interface Desk {
        Promise<Integer> serve(Integer caller, int number);

        void pause();
    }

    /** Holds its calls back now and then, and counts those that come out of order. */
    private static final class HoldingDesk extends Actor implements Desk {
        private final int[] last = new int[CALLERS];
        private final AtomicInteger outOfOrder;

        HoldingDesk(AtomicInteger outOfOrder) {
            this.outOfOrder = outOfOrder;
        }

        @Override
        public Promise<Integer> serve(Integer caller, int number) {
            if (number != ++last[caller]) {
                outOfOrder.incrementAndGet();
            }
            return Promise.of(number);
        }

        @Override
        public void pause() {
            context().hold();
            context().space().delay(Duration.ofNanos(50_000)).thenRun(context()::release);
        }
    }

    static void heldAndPooled(Round round) throws Exception {
        var outOfOrder = new AtomicInteger();
        boolean bounded = round.random.nextBoolean();
        var settings = bounded ? ActorSettings.defaults().withMailbox(20, Overflow.BLOCK) : ActorSettings.defaults();
        var spaces = List.of(space(round, "first"), space(round, "second"));
        var pool = ActorPool.on(spaces, Desk.class, () -> new HoldingDesk(outOfOrder), settings);
        var answers = new ConcurrentLinkedQueue<Promise<Integer>>();
        round.run(CALLERS, (caller, random) -> {
            for (int number = 1; number <= CALLS; number++) {
                answers.add(pool.byFirstArgument().serve(caller, number));
                if (random.nextInt(40) == 0) {
                    pool.roundRobin().pause();
                }
            }
        });
        long sum = 0;
        for (Promise<Integer> answer : answers) {
            sum += Round.get(answer);
        }
        assertThat(sum).isEqualTo((long) CALLERS * CALLS * (CALLS + 1) / 2);
        assertThat(outOfOrder).hasValue(0);
        round.end();
        assertThat(round.errors).isEmpty();
    }

    private static ActorSpace space(Round round, String name) {
        return round.random.nextBoolean() ? round.spaceWithQuota(name, 1 + round.random.nextInt(4)) : round.space(name);
    }

    // ---- subscribers that receive the newest results only

    private static final class Newest {
        final AtomicInteger received = new AtomicInteger();
        final AtomicInteger ends = new AtomicInteger();
        final Callback.Stream<Integer> stream;

        Newest(int most) {
            stream = new Callback.Stream<>(most, value -> received.incrementAndGet(), end -> ends.incrementAndGet());
        }
    }

    static void newestOnly(Round round) throws Exception {
        var home = round.space("home");
        var other = round.space("other");
        var topic = Topic.<Integer>of(home, "values");
        var subscribers = new ArrayList<Newest>();
        for (int number = 0; number < 6; number++) {
            var newest = new Newest(1 + number);
            subscribers.add(newest);
            ActorSpace space = number % 2 == 0 ? home : other;
            Round.get(space.sequential(() -> {
                topic.subscribe(newest.stream);
                return true;
            }));
        }
        round.run(CALLERS, (publisher, random) -> {
            for (int value = 0; value < CALLS; value++) {
                topic.publish(value);
                if (value % 16 == 0) {
                    Round.pause(random);
                }
            }
        });
        topic.finish();
        for (var each : subscribers) {
            Round.until("a stream has ended", () -> each.ends.get() == 1);
        }
        round.end();
        for (var each : subscribers) {
            assertThat(each.received.get() + each.stream.dropped()).isEqualTo((long) CALLERS * CALLS);
        }
        assertThat(round.errors).isEmpty();
    }

    // ---- questions that share a time limit

    /** Asks another one, which asks the first one, and so on; the last question may have no answer. */
    public static class Chain extends Actor {
        private final LongAdder begun;
        private @Nullable Chain next;

        Chain(LongAdder begun) {
            this.begun = begun;
        }

        public void setNext(Chain chain) {
            next = chain;
        }

        public Promise<Boolean> ask(int depth, boolean hasAnswer) {
            begun.increment();
            boolean isLimited = ActorSpace.timeLeft() != null;
            if (depth == 0) {
                return hasAnswer ? Promise.of(isLimited) : new Deferred<>();
            }
            return next == null
                    ? Promise.of(false)
                    : next.ask(depth - 1, hasAnswer).thenApply(below -> below && isLimited);
        }
    }

    static void sharedLimits(Round round) throws Exception {
        var begun = new LongAdder();
        var one = round.space("one");
        var two = round.space("two");
        Chain first = one.spawn(Chain.class, () -> new Chain(begun));
        Chain second = two.spawn(Chain.class, () -> new Chain(begun));
        first.setNext(second);
        second.setNext(first);
        var late = new AtomicInteger();
        var answered = new AtomicInteger();
        var free = new AtomicInteger();
        round.run(CALLERS, (caller, random) -> {
            for (int call = 0; call < CALLS / 4; call++) {
                var space = random.nextBoolean() ? one : two;
                int depth = random.nextInt(8);
                boolean hasAnswer = random.nextInt(4) > 0;
                Duration limit = Duration.ofNanos(hasAnswer && random.nextBoolean() ? 60_000_000_000L : limit(random));
                Promise<Boolean> answer = space.within(limit, () -> first.ask(depth, hasAnswer));
                Promise<Boolean> unlimited = first.ask(depth, true);
                Round.settled(answer);
                if (answer.error() instanceof TimeoutException) {
                    late.incrementAndGet();
                } else if (Round.get(answer)) {
                    answered.incrementAndGet();
                }
                if (!Round.get(unlimited)) {
                    free.incrementAndGet();
                }
            }
        });
        int calls = CALLERS * (CALLS / 4);
        assertThat(late.get() + answered.get()).isEqualTo(calls);
        assertThat(free).hasValue(calls);
        Round.until(
                "no timer is left", () -> one.metrics().timers() + two.metrics().timers() == 0);
        assertThat(one.metrics().expired() + two.metrics().expired()).isGreaterThanOrEqualTo(late.get());
        round.end();
        assertThat(begun.sum()).isPositive();
        assertThat(round.errors).isEmpty();
    }

    private static long limit(SplittableRandom random) {
        return random.nextInt(2_000_000);
    }
}
