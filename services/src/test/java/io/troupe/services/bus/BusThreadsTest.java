package io.troupe.services.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.BusContract.Count;
import io.troupe.services.bus.BusContract.Text;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.atomic.LongAdder;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(60)
class BusThreadsTest {
    private static final Duration LONG = Duration.ofSeconds(30);
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

    private InProcessBus open(int capacity) {
        return InProcessBus.open("robots", new BusSettings(space("outsiders"), capacity, loss -> {
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

    /** Hears on its own space, and checks order and repetition as it hears. */
    private static final class Listener {
        private final Map<Address, Integer> last = new HashMap<>();
        private final List<String> wrong = new ArrayList<>();
        private final Deferred<Integer> end = new Deferred<>();
        private int heard;

        void hear(Count count, Address from) {
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

    private static void inThreads(int threads, java.util.function.IntConsumer body) throws InterruptedException {
        var running = new ArrayList<Thread>();
        for (int i = 0; i < threads; i++) {
            int number = i;
            running.add(Thread.ofPlatform().start(() -> body.accept(number)));
        }
        for (Thread thread : running) {
            thread.join();
        }
    }

    private List<Listener> publishToThreeSpaces(InProcessBus bus) throws Exception {
        var listeners = new ArrayList<Listener>();
        for (int i = 0; i < 3; i++) {
            var port = bus.attach("listener" + i);
            var listener = new Listener();
            listeners.add(listener);
            space("space" + i)
                    .sequential(() -> port.subscribe(BusContract.COUNTS, listener::hear))
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

    @Test
    void everyQuestion_isSettledOnce_whileAnswerersComeAndGo() throws Exception {
        int questions = 5_000;
        var answered = new AtomicLong();
        var refused = new AtomicLong();
        var wrong = new ConcurrentLinkedQueue<String>();
        try (var bus = open(64)) {
            var home = space("answerers");
            var to = new Address("robots", "answerer");
            inThreads(THREADS, number -> {
                if (number == 0) {
                    comeAndGo(bus, home);
                    return;
                }
                var asker = bus.attach("asker" + number);
                for (int i = 0; i < questions; i++) {
                    try {
                        Text text = asker.ask(to, BusContract.SPELL, new Count(i), LONG)
                                .get(LONG);
                        answered.incrementAndGet();
                        if (!text.value().equals("" + i)) {
                            wrong.add(text + " for " + i);
                        }
                    } catch (BusException none) {
                        refused.incrementAndGet();
                    } catch (Exception other) {
                        wrong.add(other.toString());
                    }
                }
            });
            home.sequential(() -> true).get(LONG); // it counts an answer after its asker has it
            assertThat(wrong).isEmpty();
            assertThat(answered.get() + refused.get()).isEqualTo(questions * (THREADS - 1L));
            var metrics = bus.metrics();
            assertThat(metrics.asked()).isEqualTo(questions * (THREADS - 1L));
            assertThat(metrics.answered() + metrics.refused()).isEqualTo(metrics.asked());
            assertThat(metrics.timedOut()).isZero();
            assertThat(answered).as("some found an answerer").hasPositiveValue();
            assertThat(metrics.late()).isEqualTo(late.sum());
            assertThat(others).hasSize((int) metrics.undeliverable()).allMatch(Loss.Undeliverable.class::isInstance);
        }
    }

    private static void comeAndGo(InProcessBus bus, ActorSpace home) {
        for (int i = 0; i < 300; i++) {
            var port = bus.attach("answerer");
            var ready = home.sequential(() -> {
                port.answer(BusContract.SPELL, count -> Promise.of(new Text("" + count.value())));
                return port;
            });
            ready.toCompletableFuture().join();
            Thread.yield();
            port.close();
        }
        var port = bus.attach("answerer");
        home.execute(() -> port.answer(BusContract.SPELL, count -> Promise.of(new Text("" + count.value()))));
    }
}
