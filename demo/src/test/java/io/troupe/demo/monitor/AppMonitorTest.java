package io.troupe.demo.monitor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Health;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.Provider;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.Address;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.BusObserver;
import io.troupe.petri.wiring.Conformance;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.ComponentState;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Providers that fail at random do what is declared; events that are not declared are found. */
class AppMonitorTest {
    private static final int SEEDS = 100;

    private record Nothing() {}

    /** Starts, checks and stops well, badly, or never; and fails now and then. */
    private static final class Flaky implements Provider {
        private final Random random;
        private Deferred<@Nullable Void> ended = new Deferred<>();

        Flaky(Random random) {
            this.random = random;
        }

        private Promise<@Nullable Void> outcome() {
            return switch (random.nextInt(6)) {
                case 0 -> Promise.failed(new IllegalStateException("flaky"));
                case 1 -> new Deferred<>();
                default -> Promise.done();
            };
        }

        @Override
        public Promise<@Nullable Void> start() {
            ended = new Deferred<>();
            return outcome();
        }

        @Override
        public Promise<@Nullable Void> stop() {
            return outcome();
        }

        @Override
        public Promise<@Nullable Void> check() {
            return outcome();
        }

        @Override
        public Promise<@Nullable Void> whenEnded() {
            return ended;
        }
    }

    private record User() implements Broker.Connection {
        @Override
        public void use(ServiceRecord provider) {}

        @Override
        public void lost(MissingServiceException why) {}
    }

    private static AppMonitor flakyBroker(int seed) {
        var random = new Random(seed);
        var monitor = new AppMonitor(true);
        var settings = BrokerSettings.DEFAULT
                .withChecks(Duration.ofSeconds(1), Duration.ofMillis(400), 3)
                .withLimits(Duration.ofSeconds(2), Duration.ofSeconds(2), Duration.ofSeconds(1))
                .withRestart(Duration.ofSeconds(1), Duration.ofSeconds(8))
                .withObserver(monitor::onBroker);
        try (var test = new TestSpace()) {
            var broker = Broker.open(test.space(), settings);
            var gone = new boolean[3];
            List<Flaky> providers = new ArrayList<>();
            for (int i = 0; i < 3; i++) {
                var provider = new Flaky(random);
                providers.add(provider);
                register(test, broker, i, provider);
            }
            test.run(() -> ignore(broker.connect(Need.ofService("user", "clock"), new User())));
            for (int step = 0; step < 80; step++) {
                int which = random.nextInt(3);
                switch (random.nextInt(12)) {
                    case 0 ->
                        test.run(() -> broker.withdraw(new Address("test", "clock" + which))
                                .handle((done, error) -> gone[which] = true));
                    case 1 -> {
                        if (gone[which]) { // before that, the name would be that of two providers
                            gone[which] = false;
                            register(test, broker, which, providers.get(which));
                        }
                    }
                    case 2 -> test.run(() -> providers.get(which).ended.reject(new IllegalStateException("gone")));
                    default -> test.advance(Duration.ofMillis(100 + random.nextInt(900)));
                }
            }
            test.space().close();
            test.takeProblems();
            test.takeDeadLetters();
        }
        return monitor;
    }

    private static void register(TestSpace test, Broker broker, int which, Provider provider) {
        test.run(() -> ignore(broker.register("clock", List.of(), new Address("test", "clock" + which), provider)));
    }

    private static void ignore(Promise<?> promise) {
        promise.handle((done, error) -> null);
    }

    @Test
    void brokerWithFlakyProviders_conforms_andEachStepThatItNeedsWouldBeMissed() {
        var kind = LifecycleWirings.PROVIDER;
        var runs = new Conformance(kind.wiring(), kind.steps());
        for (int seed = 1; seed <= SEEDS; seed++) {
            var monitor = flakyBroker(seed);
            monitor.check();
            monitor.runs(kind).forEach(runs::add);
        }
        assertThat(runs.problems()).isEmpty();
        assertThat(runs.used())
                .hasSizeGreaterThan(15)
                .allSatisfy(step -> assertThat(runs.without(step))
                        .as("the declaration without " + step)
                        .isPresent());
        assertThat(runs.unused())
                .as("only providers that replace another one are started before they are registered")
                .extracting(Object::toString)
                .contains("provider: \"unknown\" does is being started \"starting\"");
    }

    private static final ServiceRecord CLOCK =
            new ServiceRecord("clock", List.of(), new Address("test", "clock"), Health.NOT_STARTED);

    @Test
    void providerThatIsStartedTwice_isFound() {
        var monitor = new AppMonitor();
        monitor.onBroker(new BrokerEvent.Registered(CLOCK));
        monitor.onBroker(new BrokerEvent.Starting(CLOCK));
        monitor.onBroker(new BrokerEvent.Started(CLOCK));
        monitor.check();
        monitor.onBroker(new BrokerEvent.Starting(CLOCK));
        assertThatThrownBy(monitor::check)
                .hasMessageStartingWith("provider test/clock: provider: is being started is not allowed: provider is in"
                        + " \"running\", where it may do \"could not be stopped\", or do \"has failed\"")
                .hasMessageContaining("- provider: has started");
    }

    @Test
    void componentThatRunsWithoutBeingInvoked_isFound() {
        var monitor = new AppMonitor();
        var components = monitor.components(ComponentObserver.LOG);
        components.changed(new Address("test", "hall"), ComponentState.INVOKING);
        components.changed(new Address("test", "hall"), ComponentState.RUNNING);
        monitor.check();
        components.changed(new Address("test", "lamp"), ComponentState.RUNNING);
        assertThatThrownBy(monitor::check)
                .hasMessageContaining("component test/lamp: component: runs is not allowed: component is in"
                        + " \"not invoked\", where it may do \"is being invoked\"");
    }

    @Test
    void requestThatIsAnsweredTwice_isFound() {
        var monitor = new AppMonitor();
        var bus = monitor.bus(BusObserver.logging());
        var client = new Address("test", "client");
        var server = new Address("test", "server");
        var answer = new BusMessage.Data(server, new Purpose.Reply(client, "plan", 1), 2, new Nothing());
        bus.passed(new BusMessage.Data(client, new Purpose.Request(server, "plan"), 1, new Nothing()));
        bus.passed(answer);
        monitor.check();
        bus.passed(answer);
        assertThatThrownBy(monitor::check)
                .hasMessageContaining("request 1 of test/client for plan: request: is answered is not allowed")
                .hasMessageContaining("\"new\", where it may do \"is sent\"");
    }
}
