package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.Soak;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Random programs on a broker whose providers answer at once, late, never, or with an error; see {@link Soak}. */
class BrokerSoakTest {
    private static final int STEPS = 60;
    private static final int ADDRESSES = 3;

    private long started;
    private long lateStarts;
    private long replaced;
    private long further;

    @Test
    void afterShutDown_noProviderIsAlive_andNoPromiseIsPending() {
        Soak.rounds(400, seed -> new Program(seed).run());
        assertThat(started).as("providers that ran").isPositive();
        assertThat(lateStarts).as("starts that were answered late").isPositive();
        assertThat(replaced).as("replacements").isPositive();
        assertThat(further)
                .as("lives after the first of providers with an object for each")
                .isPositive();
    }

    private final class Program extends BrokerBench {
        private final Random random;
        private final List<Moody> providers = new ArrayList<>();
        private final List<Runnable> owed = new ArrayList<>();
        private final List<Promise<?>> promises = new ArrayList<>();
        private final List<Broker.Connection> connections = new ArrayList<>();
        private boolean ending;

        Program(long seed) {
            super(BrokerSettings.defaults());
            random = new Random(seed);
        }

        /** Alive from a fulfilled start until it dies or a stop is fulfilled. */
        private final class Moody implements Provider {
            private final int number = providers.size();
            private Deferred<@Nullable Void> end = Deferred.unbound(); // of the newest start
            private Deferred<@Nullable Void> endOfLife = end; // of the newest start that was fulfilled
            private final List<Moody> earlier; // lives of the same provider
            private boolean stopped; // stop was called: a later start is late
            private boolean aliveInTime;
            boolean alive;

            Moody(List<Moody> earlier) {
                this.earlier = List.copyOf(earlier);
            }

            @Override
            public Promise<@Nullable Void> start() {
                assertThat(earlier).as("earlier lives that run").noneMatch(each -> each.aliveInTime);
                further += earlier.isEmpty() ? 0 : 1;
                Deferred<@Nullable Void> mine = Deferred.unbound();
                end = mine;
                return answer("start", true, () -> {
                    endOfLife = mine;
                    alive = true;
                    aliveInTime = !stopped;
                });
            }

            @Override
            public Promise<@Nullable Void> stop() {
                stopped = true;
                return answer("stop", false, () -> {
                    alive = false;
                    aliveInTime = false;
                });
            }

            @Override
            public Promise<@Nullable Void> check() {
                return answer("check", true, () -> {});
            }

            @Override
            public Promise<@Nullable Void> whenEnded() {
                return end;
            }

            void die() {
                if (alive) {
                    alive = false;
                    aliveInTime = false;
                    note("dies");
                    endOfLife.reject(new IllegalStateException("died"));
                }
            }

            private void note(String what) {
                diary.add("provider " + number + ": " + what);
            }

            private Promise<@Nullable Void> answer(String what, boolean mayFail, Runnable effect) {
                int manner = ending ? 0 : random.nextInt(8);
                if (manner < 3) {
                    note(what + " at once");
                    effect.run();
                    return Promise.done();
                }
                if (manner < 5 && mayFail) {
                    note(what + " fails");
                    return Promise.failed(new IllegalStateException("moody"));
                }
                note(what + " later");
                Deferred<@Nullable Void> later = Deferred.unbound();
                owed.add(() -> {
                    note("now " + what);
                    effect.run();
                    later.resolve(null);
                });
                return later;
            }
        }

        void run() {
            for (int i = 0; i < STEPS; i++) {
                step();
                if (random.nextInt(3) > 0) {
                    test.runQueued();
                }
            }
            var over = broker.closeAsync();
            seconds(100);
            assertThat(over.isDone()).as("shut down").isTrue();
            ending = true;
            while (!owed.isEmpty()) {
                giveOne();
                test.runQueued();
            }
            seconds(20);
            assertThat(providers.stream().filter(each -> each.alive))
                    .as(() -> "alive after shutDown; what they did:\n" + String.join("\n", diary))
                    .isEmpty();
            assertThat(promises).as("pending after shutDown").allMatch(Promise::isDone);
            started += events(BrokerEvent.Started.class).size();
            lateStarts += events(BrokerEvent.Late.class).stream()
                    .filter(late -> late.asked().equals("start"))
                    .count();
            replaced += events(BrokerEvent.Replaced.class).size();
            test.close();
        }

        private void step() {
            var need = Need.ofService("user", "work");
            switch (random.nextInt(11)) {
                case 0 -> settles(broker.register("work", List.of(), address(), provider()));
                case 1 -> settles(broker.register("work", List.of(), address(), new Lives()));
                case 2 -> settles(broker.withdraw(address()));
                case 3 -> settles(broker.replace(address(), "work", List.of(), address(), provider()));
                case 4, 5 -> settles(broker.require(need));
                case 6 -> {
                    if (connections.size() > 2) {
                        settles(broker.disconnect(connections.removeFirst()));
                    }
                    connections.add(new Ignorant());
                    settles(broker.connect(need, connections.getLast()));
                }
                case 7 -> {
                    if (!providers.isEmpty()) {
                        providers.get(random.nextInt(providers.size())).die();
                    }
                }
                case 8 -> giveOne();
                default -> pass(Duration.ofSeconds(1 + random.nextInt(8)));
            }
        }

        private Address address() {
            return at("p" + random.nextInt(ADDRESSES));
        }

        private Moody provider() {
            providers.add(new Moody(List.of()));
            return providers.getLast();
        }

        /** A provider with an object for each life. */
        private final class Lives implements Supplier<Provider> {
            private final List<Moody> all = new ArrayList<>();

            @Override
            public Provider get() {
                providers.add(new Moody(all));
                all.add(providers.getLast());
                return all.getLast();
            }
        }

        private void settles(Promise<?> promise) {
            promise.handle((value, error) -> null);
            promises.add(promise);
        }

        private void giveOne() {
            if (!owed.isEmpty()) {
                owed.remove(random.nextInt(owed.size())).run();
            }
        }
    }

    /** A class, because a lambda without state would be the same object each time. */
    private static final class Ignorant implements ScriptedBroker.Client {
        @Override
        public void use(ServiceRecord provider) {}
    }
}
