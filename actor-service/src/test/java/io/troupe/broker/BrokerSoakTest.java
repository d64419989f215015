package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.Soak;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Random programs on a broker whose providers answer at once, late, never, or with an error; see {@link Soak}. */
class BrokerSoakTest {
    private static final int STEPS = 60;
    private static final int ADDRESSES = 3;

    @Test
    void afterShutDown_noProviderIsAlive_andNoPromiseIsPending() {
        var statistics = new Statistics();
        Soak.rounds(400, seed -> new Program(seed, statistics).run());
        assertThat(statistics.started).as("providers that ran").isPositive();
        assertThat(statistics.lateStarts).as("starts that were answered late").isPositive();
        assertThat(statistics.replaced).as("replacements").isPositive();
    }

    private static final class Statistics {
        long started;
        long lateStarts;
        long replaced;
    }

    private static final class Program {
        private final Random random;
        private final Statistics statistics;
        private final BrokerBench bench = new BrokerBench();
        private final List<Moody> providers = new ArrayList<>();
        private final List<Runnable> owed = new ArrayList<>();
        private final List<Promise<?>> promises = new ArrayList<>();
        private final List<Broker.Connection> connections = new ArrayList<>();
        private boolean ending;

        Program(long seed, Statistics statistics) {
            this.random = new Random(seed);
            this.statistics = statistics;
        }

        /** Alive from a fulfilled start until it dies or a stop is fulfilled. */
        private final class Moody implements Provider {
            private final int number = providers.size();
            private Deferred<@Nullable Void> end = new Deferred<>(null); // of the newest start
            private Deferred<@Nullable Void> endOfLife = end; // of the newest start that was fulfilled
            boolean alive;

            @Override
            public Promise<@Nullable Void> start() {
                var mine = new Deferred<@Nullable Void>(null);
                end = mine;
                return answer("start", true, () -> {
                    endOfLife = mine;
                    alive = true;
                });
            }

            @Override
            public Promise<@Nullable Void> stop() {
                return answer("stop", false, () -> alive = false);
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
                    bench.diary.add(this + ": dies");
                    endOfLife.reject(new IllegalStateException("died"));
                }
            }

            @Override
            public String toString() {
                return "provider " + number;
            }

            private Promise<@Nullable Void> answer(String what, boolean mayFail, Runnable effect) {
                int manner = ending ? 0 : random.nextInt(8);
                bench.diary.add(
                        this + ": " + what + (manner < 3 ? " at once" : manner < 5 && mayFail ? " fails" : " later"));
                if (manner < 3) {
                    effect.run();
                    return Promise.done();
                }
                if (manner < 5 && mayFail) {
                    return Promise.failed(new IllegalStateException("moody"));
                }
                var later = new Deferred<@Nullable Void>(null);
                owed.add(() -> {
                    bench.diary.add(this + ": now " + what);
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
                    bench.test.crank();
                }
            }
            var over = bench.broker.shutDown();
            bench.seconds(100);
            assertThat(over.isDone()).as("shut down").isTrue();
            ending = true;
            while (!owed.isEmpty()) {
                giveOne();
                bench.test.crank();
            }
            bench.seconds(20);
            assertThat(providers.stream().filter(each -> each.alive))
                    .as(() -> "alive after shutDown; what they did:\n" + String.join("\n", bench.diary))
                    .isEmpty();
            assertThat(promises).as("pending after shutDown").allMatch(Promise::isDone);
            statistics.started += bench.events(BrokerEvent.Started.class).size();
            statistics.lateStarts += bench.events(BrokerEvent.Late.class).stream()
                    .filter(late -> late.asked().equals("start"))
                    .count();
            statistics.replaced += bench.events(BrokerEvent.Replaced.class).size();
            bench.test.close();
        }

        private void step() {
            switch (random.nextInt(11)) {
                case 0, 1 -> settles(bench.broker.register("work", List.of(), address(), provider()));
                case 2 -> settles(bench.broker.withdraw(address()));
                case 3 -> settles(bench.broker.replace(address(), "work", List.of(), address(), provider()));
                case 4, 5 -> settles(bench.broker.require(Need.ofService("user", "work")));
                case 6 -> connect();
                case 7 -> {
                    if (!providers.isEmpty()) {
                        providers.get(random.nextInt(providers.size())).die();
                    }
                }
                case 8 -> giveOne();
                default -> bench.pass(Duration.ofSeconds(1 + random.nextInt(8)));
            }
        }

        private io.troupe.bus.Address address() {
            return BrokerBench.at("p" + random.nextInt(ADDRESSES));
        }

        private Moody provider() {
            providers.add(new Moody());
            return providers.getLast();
        }

        private void settles(Promise<?> promise) {
            promise.handle((value, error) -> null);
            promises.add(promise);
        }

        private void connect() {
            if (connections.size() > 2) {
                settles(bench.broker.disconnect(connections.removeFirst()));
            }
            var connection = new Broker.Connection() {
                @Override
                public void use(ServiceRecord provider) {}

                @Override
                public void lost(MissingServiceException why) {}
            };
            connections.add(connection);
            settles(bench.broker.connect(Need.ofService("user", "work"), connection));
        }

        private void giveOne() {
            if (!owed.isEmpty()) {
                owed.remove(random.nextInt(owed.size())).run();
            }
        }
    }
}
