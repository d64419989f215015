package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.BusContract.Count;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.LongAdder;
import org.junit.jupiter.api.Test;

/** Several threads use one bus while ports, subscriptions and request handlers come and go; see {@link Soak}. */
class BusSoakTest {
    private static final Duration LONG = Duration.ofMinutes(10);
    private static final int VALUES = 3_000;
    private static final int PUBLISHERS = 2;
    private static final int COMING_AND_GOING = 2;

    @Test
    void requests_areSettledOnceEach() {
        int requesters = 3;
        int questions = 1_000;
        Soak.rounds(1, round -> {
            var losses = new LongAdder();
            try (var outside = ActorSpace.create(SpaceSettings.named("outside"));
                    var home = ActorSpace.create(SpaceSettings.named("answerers"));
                    var bus = Bus.inProcess("robots", new BusSettings(outside, 64, loss -> losses.increment()))) {
                var all = new BusThreadsTest.Requesters(requesters, 100);
                var to = new Address("robots", "answerer");
                inThreads(requesters + 1, number -> {
                    if (number == 0) {
                        all.comeAndGo(bus, home);
                    } else {
                        all.ask(bus.attach("asker" + number), to, questions);
                    }
                });
                wait(home.sequential(() -> true));
                assertThat(all.wrong).isEmpty();
                assertThat(all.answered.get() + all.refused.get()).isEqualTo(requesters * questions);
                var metrics = bus.metrics();
                assertThat(metrics.answered()).isEqualTo(all.answered.get()).isPositive();
                assertThat(metrics.refused()).isEqualTo(all.refused.get());
                assertThat(metrics.undeliverable() + metrics.late()).isEqualTo(losses.sum());
            }
        });
    }

    /** Checks the order of each publisher's values. Runs on the subscriber's space. */
    private static final class Listener {
        private final ConcurrentLinkedQueue<String> wrong;
        private final LongAdder heard;
        private final Map<Address, Integer> last = new HashMap<>();

        Listener(ConcurrentLinkedQueue<String> wrong, LongAdder heard) {
            this.wrong = wrong;
            this.heard = heard;
        }

        void receive(Count count, Address from) {
            heard.increment();
            int before = last.getOrDefault(from, -1);
            if (count.value() <= before) {
                wrong.add(from + ": " + count.value() + " after " + before);
            }
            last.put(from, count.value());
        }
    }

    @Test
    void values_keepTheirOrder_andAddUp_whileSubscribersComeAndGo() {
        Soak.rounds(1, round -> {
            var wrong = new ConcurrentLinkedQueue<String>();
            var heard = new LongAdder();
            var heardByTheFirst = new LongAdder();
            var publishing = new AtomicInteger(PUBLISHERS);
            try (var outside = ActorSpace.create(SpaceSettings.named("outside"));
                    var left = ActorSpace.create(SpaceSettings.named("left"));
                    var right = ActorSpace.create(SpaceSettings.named("right"))) {
                var bus = Bus.inProcess("robots", new BusSettings(outside, PUBLISHERS * VALUES, loss -> {}));
                var first = new Listener(wrong, heardByTheFirst);
                subscribe(bus.attach("first"), left, first);
                inThreads(PUBLISHERS + COMING_AND_GOING, number -> {
                    if (number < PUBLISHERS) {
                        var port = bus.attach("publisher" + number);
                        for (int i = 0; i < VALUES; i++) {
                            port.publish(BusContract.COUNTS, new Count(i));
                        }
                        publishing.decrementAndGet();
                    } else {
                        var port = bus.attach("subscriber" + number);
                        for (int i = 0; i == 0 || publishing.get() > 0; i++) {
                            var space = i % 2 == 0 ? left : right;
                            var subscription = subscribe(port, space, new Listener(wrong, heard));
                            Thread.yield();
                            if (i % 3 == 0) {
                                port.close();
                                port = bus.attach("subscriber" + number);
                            } else {
                                subscription.close();
                            }
                        }
                    }
                });
                while (heardByTheFirst.sum() < PUBLISHERS * VALUES) {
                    wait(left.sequential(() -> true));
                }
                bus.close();
                for (var space : List.of(left, right)) {
                    wait(space.sequential(() -> true));
                }
                var metrics = bus.metrics();
                assertThat(wrong).isEmpty();
                assertThat(heardByTheFirst.sum()).isEqualTo(PUBLISHERS * VALUES);
                assertThat(metrics.published()).isEqualTo(PUBLISHERS * VALUES);
                assertThat(metrics.delivered()).isEqualTo(heard.sum() + heardByTheFirst.sum());
                assertThat(metrics.queued())
                        .isEqualTo(metrics.delivered() + metrics.failed() + metrics.dropped() + metrics.discarded());
            }
        });
    }

    private static BusPort.Subscription subscribe(BusPort port, ActorSpace space, Listener listener) {
        return wait(space.sequential(() -> port.subscribe(BusContract.COUNTS, listener::receive)));
    }

    private static <T> T wait(Promise<T> promise) {
        try {
            return promise.get(LONG);
        } catch (Exception failure) {
            throw new AssertionError(failure);
        }
    }

    private static void inThreads(int threads, java.util.function.IntConsumer body) {
        try {
            BusThreadsTest.inThreads(threads, body);
        } catch (InterruptedException failure) {
            throw new AssertionError(failure);
        }
    }
}
