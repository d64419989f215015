package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
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
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(600)
class BusThreadsTest {
    private static final Duration LONG = Duration.ofMinutes(10);
    private static final int THREADS = 4;
    private static final int VALUES = 10_000;
    private static final Count END = new Count(-1);

    private final List<ActorSpace> spaces = new ArrayList<>();
    private final AtomicLong dropped = new AtomicLong();
    private final LongAdder late = new LongAdder();
    private final ConcurrentLinkedQueue<Loss> others = new ConcurrentLinkedQueue<>();

    private ActorSpace space(String name) {
        var space = ActorSpace.create(SpaceSettings.named(name));
        spaces.add(space);
        return space;
    }

    private Bus open(int capacity) {
        return Bus.inProcess("robots", new BusSettings(space("outsiders"), capacity, loss -> {
            switch (loss) {
                case Loss.Dropped one -> dropped.incrementAndGet();
                case Loss.Late one -> late.increment();
                default -> others.add(loss);
            }
        }));
    }

    @AfterEach
    void close() {
        spaces.forEach(ActorSpace::close);
    }

    /** A subscriber on a separate space that checks order and repetition of the values it receives. */
    private static final class Listener {
        private final Map<Address, Integer> last = new HashMap<>();
        private final List<String> wrong = new ArrayList<>();
        private final Deferred<Integer> end = new Deferred<>();
        private int heard;

        void receive(Count count, Address from) {
            heard++;
            if (count.equals(END)) {
                end.resolve(heard);
                return;
            }
            int before = last.getOrDefault(from, -1);
            if (count.value() <= before) {
                wrong.add(from + ": " + count.value() + " after " + before);
            }
            last.put(from, count.value());
        }
    }

    static void inThreads(int threads, java.util.function.IntConsumer body) throws InterruptedException {
        var running = new ArrayList<Thread>();
        for (int i = 0; i < threads; i++) {
            int number = i;
            running.add(Thread.ofPlatform().start(() -> body.accept(number)));
        }
        for (Thread thread : running) {
            thread.join();
        }
    }

    private List<Listener> publishToThreeSpaces(Bus bus) throws Exception {
        var listeners = new ArrayList<Listener>();
        for (int i = 0; i < 3; i++) {
            var port = bus.attach("listener" + i);
            var listener = new Listener();
            listeners.add(listener);
            space("space" + i)
                    .sequential(() -> port.subscribe(BusContract.COUNTS, listener::receive))
                    .get(LONG);
        }
        inThreads(THREADS, number -> {
            var port = bus.attach("publisher" + number);
            for (int value = 0; value < VALUES; value++) {
                port.publish(BusContract.COUNTS, new Count(value));
            }
        });
        bus.attach("last").publish(BusContract.COUNTS, END);
        for (var listener : listeners) {
            listener.end.get(LONG);
            assertThat(listener.wrong).isEmpty();
        }
        return listeners;
    }

    @Test
    void values_ofSeveralThreads_reachEverySpace_inOrder_onceEach() throws Exception {
        try (var bus = open(THREADS * VALUES + 1)) {
            for (var listener : publishToThreeSpaces(bus)) {
                assertThat(listener.end.get(LONG)).isEqualTo(THREADS * VALUES + 1);
            }
            assertThat(dropped).hasValue(0);
        }
        assertThat(others).isEmpty();
    }

    @Test
    void valuesThatAreDropped_areCountedOneByOne_andTheOthersKeepTheirOrder() throws Exception {
        try (var bus = open(16)) {
            long heard = 0;
            for (var listener : publishToThreeSpaces(bus)) {
                heard += listener.end.get(LONG);
            }
            assertThat(heard + dropped.get()).isEqualTo(3L * (THREADS * VALUES + 1));
            assertThat(bus.metrics().queued()).isEqualTo(3L * (THREADS * VALUES + 1));
            assertThat(bus.metrics().dropped()).isEqualTo(dropped.get());
        }
        assertThat(others).isEmpty();
    }

    /**
     * Requests from several threads to one address, while request handlers come and go. Each handler stays until it has
     * been used.
     */
    static final class Requesters {
        private final int lives;
        final AtomicLong answered = new AtomicLong();
        final AtomicLong refused = new AtomicLong();
        final ConcurrentLinkedQueue<String> wrong = new ConcurrentLinkedQueue<>();
        private final AtomicInteger asking;
        private final CountDownLatch firstIsThere = new CountDownLatch(1);

        Requesters(int requesters, int lives) {
            this.asking = new AtomicInteger(requesters);
            this.lives = lives;
        }

        void ask(BusPort requester, Address to, int questions) {
            try {
                firstIsThere.await();
                for (int i = 0; i < questions; i++) {
                    ask(requester, to, new Count(i));
                }
            } catch (InterruptedException interrupted) {
                wrong.add(interrupted.toString());
            } finally {
                asking.decrementAndGet();
            }
        }

        private void ask(BusPort requester, Address to, Count count) {
            try {
                Text text = requester.ask(to, BusContract.SPELL, count, LONG).get(LONG);
                answered.incrementAndGet();
                if (!text.value().equals("" + count.value())) {
                    wrong.add(text + " for " + count);
                }
            } catch (BusException none) {
                refused.incrementAndGet();
            } catch (Exception other) {
                wrong.add(other.toString());
            }
        }

        /** Makes sure that the requesters meet phases with and without a handler, independent of thread scheduling. */
        void comeAndGo(Bus bus, ActorSpace home) {
            for (int i = 0; i < lives; i++) {
                long answeredBefore = answered.get();
                var port = handler(bus, home);
                firstIsThere.countDown();
                awaitMoreThan(answeredBefore, answered);
                long refusedBefore = refused.get();
                port.close();
                awaitMoreThan(refusedBefore, refused);
            }
            handler(bus, home);
        }

        private void awaitMoreThan(long before, AtomicLong count) {
            while (count.get() == before && asking.get() > 0) {
                Thread.onSpinWait();
                Thread.yield();
            }
        }

        private static BusPort handler(Bus bus, ActorSpace home) {
            var port = bus.attach("answerer");
            home.sequential(() -> {
                        port.answer(BusContract.SPELL, count -> Promise.of(new Text("" + count.value())));
                        return port;
                    })
                    .toCompletableFuture()
                    .join();
            return port;
        }
    }

    @Test
    void everyRequest_isSettledOnce_whileHandlersComeAndGo() throws Exception {
        int questions = 5_000;
        var requesters = new Requesters(THREADS - 1, 300);
        try (var bus = open(64)) {
            var home = space("answerers");
            var to = new Address("robots", "answerer");
            inThreads(THREADS, number -> {
                if (number == 0) {
                    requesters.comeAndGo(bus, home);
                } else {
                    requesters.ask(bus.attach("asker" + number), to, questions);
                }
            });
            home.sequential(() -> true).get(LONG); // the reply is counted after the requester has received it
            assertThat(requesters.wrong).isEmpty();
            assertThat(requesters.answered).as("found an answerer").hasPositiveValue();
            assertThat(requesters.refused).as("found none").hasPositiveValue();
            var metrics = bus.metrics();
            assertThat(metrics.asked()).isEqualTo(questions * (THREADS - 1L));
            assertThat(metrics.answered()).isEqualTo(requesters.answered.get());
            assertThat(metrics.refused()).isEqualTo(requesters.refused.get());
            assertThat(metrics.answered() + metrics.refused()).isEqualTo(metrics.asked());
            assertThat(metrics.timedOut()).isZero();
            assertThat(metrics.late()).isEqualTo(late.sum());
            assertThat(others).hasSize((int) metrics.undeliverable()).allMatch(Loss.Undeliverable.class::isInstance);
        }
    }
}
