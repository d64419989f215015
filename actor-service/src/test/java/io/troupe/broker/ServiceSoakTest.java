package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Soak;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.Callable;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.LongAdder;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * Threads call a service whose actor holds its calls back now and then and is replaced meanwhile, on spaces with
 * quotas, with and without a limit; others watch its newest values; see {@link Soak}.
 */
class ServiceSoakTest {
    private static final Duration LONG = Duration.ofMinutes(10);
    private static final BrokerSettings BROKER = BrokerSettings.defaults()
            .withCheckEvery(LONG)
            .withCheckLimit(LONG)
            .withMissedChecks(3)
            .withStartLimit(LONG)
            .withStopLimit(LONG)
            .withNotifyLimit(LONG);
    private static final ConnectionSettings CONNECTION = ConnectionSettings.defaults()
            .withWaitLimit(LONG)
            .withAnswerLimit(LONG)
            .withOneWayLimit(LONG);
    private static final int CALLERS = 3;
    private static final int CALLS = 300;
    private static final int REPLACEMENTS = 5;

    /** Serves numbers. */
    interface Desk {
        Promise<Integer> serve(int number);

        void pause();

        /** Reports the count of each number served from now on, until this actor ends. */
        void watch(Callback<Integer> counts);
    }

    private static final class HoldingDesk extends Actor implements Desk {
        private final LongAdder served;
        private final List<Callback<Integer>> watchers = new ArrayList<>();
        private int count;

        HoldingDesk(LongAdder served) {
            this.served = served;
        }

        @Override
        public Promise<Integer> serve(int number) {
            served.increment();
            count++;
            watchers.forEach(each -> each.next(count));
            return Promise.of(number);
        }

        @Override
        public void pause() {
            context().hold();
            context().space().delay(Duration.ofNanos(50_000)).thenRun(context()::release);
        }

        @Override
        public void watch(Callback<Integer> counts) {
            watchers.add(counts);
        }

        @Override
        protected void stopped() {
            watchers.forEach(Callback::finish);
        }
    }

    /** Watches the newest counts of one actor. */
    private static final class Watcher {
        final AtomicInteger ends = new AtomicInteger();
        final AtomicInteger outOfOrder = new AtomicInteger();
        private int last;

        Callback<Integer> counts(int most) {
            return new Callback.Stream<>(most, this::next, end -> ends.incrementAndGet());
        }

        private void next(int count) {
            if (count <= last) {
                outOfOrder.incrementAndGet();
            }
            last = count;
        }
    }

    private static ActorSpace space(SplittableRandom random, String name) {
        var settings = SpaceSettings.named(name).withoutStallLimit();
        return ActorSpace.create(random.nextBoolean() ? settings.withActorQuota(1 + random.nextInt(4)) : settings);
    }

    @Test
    @Timeout(1_200)
    void calls_ofAServiceThatHoldsAndIsReplaced_areServedOnce_orEndByTheirLimit_orWithTheirProvider() {
        Soak.rounds(2, ServiceSoakTest::round);
    }

    private static void round(long seed) {
        var random = new SplittableRandom(seed);
        var served = new LongAdder();
        var fulfilled = new LongAdder();
        var late = new LongAdder();
        var lost = new LongAdder();
        var watchers = new ArrayList<Watcher>();
        try (var brokers = space(random, "brokers");
                var providers = space(random, "providers");
                var callers = space(random, "callers");
                var threads = Executors.newVirtualThreadPerTaskExecutor()) {
            var broker = Broker.open(brokers, BROKER.withObserver(event -> {}));
            var services = new ActorServices(broker, "node", callers, event -> {}, null);
            var now = services.publish(providers, Desk.class, "desk", List.of(), () -> new HoldingDesk(served))
                    .get(LONG)
                    .provider();
            Desk desk = services.connect(Desk.class, Need.ofService("till", "desk"), CONNECTION)
                    .actor();
            var load = new ArrayList<Future<@Nullable Void>>();
            for (int caller = 0; caller < CALLERS; caller++) {
                var own = random.split();
                load.add(threads.submit(call(desk, callers, own, fulfilled, late, lost)));
            }
            for (int i = 0; i < REPLACEMENTS; i++) {
                var watcher = new Watcher();
                watchers.add(watcher);
                callers.sequential(() -> {
                            desk.watch(watcher.counts(1 + random.nextInt(3)));
                            return true;
                        })
                        .get(LONG);
                now = services.replace(now, providers, Desk.class, "desk", List.of(), () -> new HoldingDesk(served))
                        .get(LONG)
                        .provider();
            }
            for (var each : load) {
                each.get();
            }
            assertThat(broker.closeAsync().get(LONG)).isEmpty();
        } catch (Exception failure) {
            throw new AssertionError(failure);
        }
        assertThat(fulfilled.sum() + late.sum() + lost.sum())
                .as("calls that were settled")
                .isEqualTo((long) CALLERS * CALLS);
        assertThat(served.sum()).as("calls that ran").isBetween(fulfilled.sum(), (long) CALLERS * CALLS);
        assertThat(watchers).allSatisfy(each -> {
            assertThat(each.ends).as("ends of a callback").hasValue(1);
            assertThat(each.outOfOrder).hasValue(0);
        });
    }

    private static Callable<@Nullable Void> call(
            Desk desk,
            ActorSpace callers,
            SplittableRandom random,
            LongAdder fulfilled,
            LongAdder late,
            LongAdder lost) {
        return () -> {
            for (int number = 0; number < CALLS; number++) {
                int mine = number;
                boolean isLimited = random.nextInt(3) == 0;
                Promise<Integer> answer = isLimited
                        ? callers.within(Duration.ofNanos(random.nextInt(2_000_000)), () -> desk.serve(mine))
                        : desk.serve(mine);
                if (random.nextInt(40) == 0) {
                    desk.pause();
                }
                try {
                    assertThat(answer.get(LONG)).isEqualTo(mine);
                    fulfilled.increment();
                } catch (TimeoutException limit) {
                    assertThat(isLimited).isTrue();
                    late.increment();
                } catch (ServiceCallException ended) { // it held the call back when it was replaced
                    assertThat(ended).hasMessageContaining(" ended while ");
                    lost.increment();
                }
            }
            return null;
        };
    }
}
