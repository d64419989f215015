package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.BusContract.Count;
import io.troupe.bus.BusContract.Text;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.IntConsumer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Several threads use one bus. {@link Soak} repeats some of these tests with ports that come and go. */
class BusThreadsTest {
    private static final Duration LONG = Duration.ofMinutes(10);
    private static final int THREADS = 4;
    private static final int VALUES = 10_000;
    private static final Count END = new Count(-1);

    private final List<ActorSpace> spaces = new ArrayList<>();
    private final AtomicLong dropped = new AtomicLong();
    private final LongAdder late = new LongAdder();
    private final ConcurrentLinkedQueue<Loss> others = new ConcurrentLinkedQueue<>();
    private final ConcurrentLinkedQueue<String> wrong = new ConcurrentLinkedQueue<>();

    private ActorSpace space(String name) {
        var space = ActorSpace.create(SpaceSettings.named(name));
        spaces.add(space);
        return space;
    }

    private Bus open(int capacity) {
        dropped.set(0);
        late.reset();
        others.clear();
        return Bus.inProcess(
                "robots",
                BusSettings.on(space("outsiders")).withCapacity(capacity).withObserver(loss -> {
                    switch (loss) {
                        case Loss.Dropped one -> dropped.incrementAndGet();
                        case Loss.Late one -> late.increment();
                        default -> others.add(loss);
                    }
                }));
    }

    @AfterEach
    void closeSpaces() {
        spaces.forEach(ActorSpace::close);
        spaces.clear();
    }

    private static <T> T await(Promise<T> promise) {
        try {
            return promise.get(LONG);
        } catch (Exception failure) {
            throw new AssertionError(failure);
        }
    }

    private static void inThreads(int threads, IntConsumer body) {
        var running = new ArrayList<Thread>();
        for (int i = 0; i < threads; i++) {
            int number = i;
            running.add(Thread.ofPlatform().start(() -> body.accept(number)));
        }
        try {
            for (Thread thread : running) {
                thread.join();
            }
        } catch (InterruptedException failure) {
            throw new AssertionError(failure);
        }
    }

    // ---- values

    /** A subscriber on a separate space that checks order and repetition of the values of each publisher. */
    private final class Listener {
        private final Map<Address, Integer> last = new HashMap<>();
        private final Deferred<Integer> end = new Deferred<>();
        private final LongAdder received;

        Listener(LongAdder received) {
            this.received = received;
        }

        BusPort.Subscription subscribe(BusPort port, ActorSpace space) {
            return await(space.sequential(() -> port.subscribe(BusContract.COUNTS, this::receive)));
        }

        private void receive(Count count, Address from) {
            received.increment();
            if (count.equals(END)) {
                end.resolve(received.intValue());
                return;
            }
            int before = last.getOrDefault(from, -1);
            if (count.value() <= before) {
                wrong.add(from + ": " + count.value() + " after " + before);
            }
            last.put(from, count.value());
        }
    }

    private static void publish(BusPort port, int values) {
        for (int value = 0; value < values; value++) {
            port.publish(BusContract.COUNTS, new Count(value));
        }
    }

    @Timeout(600)
    @ParameterizedTest
    @ValueSource(ints = {THREADS * VALUES + 1, 16})
    void values_ofSeveralThreads_reachEverySpace_inOrder_onceEach_orAreCountedAsDropped(int capacity) {
        long sent = THREADS * VALUES + 1;
        try (var bus = open(capacity)) {
            var listeners = new ArrayList<Listener>();
            for (int i = 0; i < 3; i++) {
                listeners.add(new Listener(new LongAdder()));
                listeners.getLast().subscribe(bus.attach("listener" + i), space("space" + i));
            }
            inThreads(THREADS, number -> publish(bus.attach("publisher" + number), VALUES));
            bus.attach("last").publish(BusContract.COUNTS, END);
            var received =
                    listeners.stream().map(each -> (long) await(each.end)).toList();
            assertThat(wrong).isEmpty();
            if (capacity == sent) {
                assertThat(received).containsExactly(sent, sent, sent);
                assertThat(dropped).hasValue(0);
            }
            assertThat(received.stream().mapToLong(each -> each).sum() + dropped.get())
                    .isEqualTo(3 * sent);
            assertThat(bus.metrics().queued()).isEqualTo(3 * sent);
            assertThat(bus.metrics().dropped()).isEqualTo(dropped.get());
        }
        assertThat(others).isEmpty();
    }

    @Test
    void values_keepTheirOrder_andAddUp_whileSubscribersComeAndGo() {
        int publishers = 2;
        int comingAndGoing = 2;
        int values = 3_000;
        Soak.rounds(1, round -> {
            var received = new LongAdder();
            var receivedByTheFirst = new LongAdder();
            var publishing = new AtomicInteger(publishers);
            var left = space("left");
            var right = space("right");
            var bus = open(publishers * values);
            new Listener(receivedByTheFirst).subscribe(bus.attach("first"), left);
            inThreads(publishers + comingAndGoing, number -> {
                if (number < publishers) {
                    publish(bus.attach("publisher" + number), values);
                    publishing.decrementAndGet();
                    return;
                }
                var port = bus.attach("subscriber" + number);
                for (int i = 0; i == 0 || publishing.get() > 0; i++) {
                    var subscription = new Listener(received).subscribe(port, i % 2 == 0 ? left : right);
                    Thread.yield();
                    if (i % 3 == 0) {
                        port.close();
                        port = bus.attach("subscriber" + number);
                    } else {
                        subscription.close();
                    }
                }
            });
            while (receivedByTheFirst.sum() < publishers * values) {
                await(left.sequential(() -> true));
            }
            bus.close();
            for (var space : List.of(left, right)) {
                await(space.sequential(() -> true));
            }
            var metrics = bus.metrics();
            assertThat(wrong).isEmpty();
            assertThat(receivedByTheFirst.sum()).isEqualTo(publishers * values);
            assertThat(metrics.published()).isEqualTo(publishers * values);
            assertThat(metrics.delivered()).isEqualTo(received.sum() + receivedByTheFirst.sum());
            assertThat(metrics.queued())
                    .isEqualTo(metrics.delivered() + metrics.failed() + metrics.dropped() + metrics.droppedAtEnd());
            closeSpaces();
        });
    }

    // ---- requests

    /**
     * Requests from several threads to one address, while request handlers come and go. Each handler stays until it has
     * been used.
     */
    private final class Requesters {
        private final Bus bus = open(64);
        private final ActorSpace home = space("answerers");
        private final AtomicLong answered = new AtomicLong();
        private final AtomicLong refused = new AtomicLong();
        private final AtomicInteger asking = new AtomicInteger(THREADS - 1);
        private final CountDownLatch firstIsThere = new CountDownLatch(1);

        void run(int questions, int lives) {
            inThreads(THREADS, number -> {
                if (number == 0) {
                    comeAndGo(lives);
                } else {
                    ask(bus.attach("asker" + number), questions);
                }
            });
            await(home.sequential(() -> true)); // the reply is counted after the requester has received it
            assertThat(wrong).isEmpty();
            assertThat(answered).as("found an answerer").hasPositiveValue();
            var metrics = bus.metrics();
            assertThat(metrics.asked()).isEqualTo(questions * (THREADS - 1L));
            assertThat(metrics.answered()).isEqualTo(answered.get());
            assertThat(metrics.rejected()).isEqualTo(refused.get());
            assertThat(metrics.answered() + metrics.rejected()).isEqualTo(metrics.asked());
            assertThat(metrics.timedOut()).isZero();
            assertThat(metrics.late()).isEqualTo(late.sum());
            assertThat(others).hasSize((int) metrics.undeliverable()).allMatch(Loss.Undeliverable.class::isInstance);
            bus.close();
            closeSpaces();
        }

        private void ask(BusPort requester, int questions) {
            try {
                firstIsThere.await();
                for (int i = 0; i < questions; i++) {
                    ask(requester, new Count(i));
                }
            } catch (InterruptedException interrupted) {
                wrong.add(interrupted.toString());
            } finally {
                asking.decrementAndGet();
            }
        }

        private void ask(BusPort requester, Count count) {
            try {
                var to = new Address("robots", "answerer");
                var text = requester.ask(to, BusContract.SPELL, count, LONG).get(LONG);
                answered.incrementAndGet();
                if (!text.equals(new Text("" + count.value()))) {
                    wrong.add(text + " for " + count);
                }
            } catch (BusException none) {
                refused.incrementAndGet();
            } catch (Exception other) {
                wrong.add(other.toString());
            }
        }

        /** Makes sure that the requesters meet phases with and without a handler, independent of thread scheduling. */
        private void comeAndGo(int lives) {
            for (int i = 0; i < lives; i++) {
                long answeredBefore = answered.get();
                var port = handler();
                firstIsThere.countDown();
                awaitMoreThan(answeredBefore, answered);
                long refusedBefore = refused.get();
                port.close();
                awaitMoreThan(refusedBefore, refused);
            }
            handler();
        }

        private void awaitMoreThan(long before, AtomicLong count) {
            while (count.get() == before && asking.get() > 0) {
                Thread.onSpinWait();
                Thread.yield();
            }
        }

        private BusPort handler() {
            var port = bus.attach("answerer");
            return await(home.sequential(() -> {
                port.answer(BusContract.SPELL, count -> Promise.of(new Text("" + count.value())));
                return port;
            }));
        }
    }

    @Timeout(600)
    @Test
    void everyRequest_isSettledOnce_whileHandlersComeAndGo() {
        var requesters = new Requesters();
        requesters.run(5_000, 300);
        assertThat(requesters.refused).as("found none").hasPositiveValue();
    }

    @Test
    void requests_areSettledOnceEach() {
        Soak.rounds(1, round -> new Requesters().run(1_000, 100));
    }
}
