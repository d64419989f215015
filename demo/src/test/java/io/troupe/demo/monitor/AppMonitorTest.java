package io.troupe.demo.monitor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
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
import io.troupe.bus.Bus;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import io.troupe.petri.wiring.Conformance;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.Conversion;
import io.troupe.tools.Thorough;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.atomic.AtomicBoolean;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Providers that fail at random do what is declared; events that are not declared are found. */
class AppMonitorTest {
    private static final int SEEDS = Thorough.times(20, 100);

    private static final BrokerSettings FLAKY = BrokerSettings.defaults()
            .withCheckEvery(Duration.ofSeconds(1))
            .withCheckLimit(Duration.ofMillis(400))
            .withMissedChecks(3)
            .withStartLimit(Duration.ofSeconds(2))
            .withStopLimit(Duration.ofSeconds(2))
            .withNotifyLimit(Duration.ofSeconds(1))
            .withRestartPauses(Duration.ofSeconds(1), Duration.ofSeconds(8));

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
        var settings = FLAKY.withObserver(monitor::onBroker);
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

    /** A value that a component publishes, and a question with its answer. */
    private record Tick(int number) {}

    private static final BusTopic<Tick> TICKS = new BusTopic<>("ticks", Tick.class);
    private static final Operation<Tick, Tick> NEXT =
            new Operation<>("next", Tick.class, Tick.class, Operation.Kind.DATA);

    /** Is invoked and terminated well, badly, or after a while; publishes and fails at any time. */
    private static final class FlakyComponent implements ComponentCommunication<Tick, Tick> {
        private final Random random;
        private final List<Deferred<@Nullable Void>> open = new ArrayList<>();
        private @Nullable Signals<? super Tick> signals;

        FlakyComponent(Random random) {
            this.random = random;
        }

        private Promise<@Nullable Void> outcome() {
            var later = new Deferred<@Nullable Void>();
            switch (random.nextInt(5)) {
                case 0 -> later.reject(new IllegalStateException("flaky"));
                case 1, 2 -> open.add(later);
                default -> later.resolve(null);
            }
            return later;
        }

        @Override
        public Promise<@Nullable Void> invoke(Signals<? super Tick> newSignals) {
            signals = newSignals;
            return outcome();
        }

        @Override
        public Promise<@Nullable Void> terminate() {
            return outcome();
        }

        @Override
        public Promise<@Nullable Void> health() {
            return Promise.done();
        }

        @Override
        public void data(Tick input) {}

        void act() {
            var to = signals;
            switch (random.nextInt(4)) {
                case 0 -> open.forEach(each -> each.resolve(null));
                case 1 -> {
                    if (to != null) {
                        to.failed(new IllegalStateException("gone"));
                    }
                }
                default -> {
                    if (to != null) {
                        to.data(new Tick(random.nextInt(100)));
                    }
                }
            }
        }
    }

    private static final class Ticks implements Conversion<Tick, Tick> {
        @Override
        public List<ApplicationData<?>> toApplication(Tick output) {
            return List.of(new ApplicationData<>(TICKS, output));
        }

        @Override
        public Tick toComponent(ApplicationData<?> input) {
            return (Tick) input.value();
        }
    }

    private static AppMonitor flakyComponent(int seed) {
        var random = new Random(seed);
        var monitor = new AppMonitor(true);
        try (var test = new TestSpace()) {
            var bus = Bus.inProcess("test", BusSettings.on(test.space()).withObserver(monitor.bus(loss -> {})));
            var communication = new FlakyComponent(random);
            var component = new Component<>(
                    "ticker",
                    List.of(),
                    List.of(),
                    List.of(TICKS),
                    () -> communication,
                    new Ticks(),
                    Buffering.STREAM,
                    Buffering.STREAM);
            var quiet = new ComponentObserver() {
                @Override
                public void dropped(Address from, ApplicationData<?> lost, long total) {}

                @Override
                public void problem(Address from, String what, Throwable why) {}

                @Override
                public void info(Address from, String what) {}
            };
            var broker = Broker.open(test.space(), FLAKY.withObserver(monitor::onBroker));
            var opened = new ArrayList<ComponentInterface<Tick, Tick>>();
            var user = new ArrayList<BusPort>();
            test.run(() -> {
                opened.add(ComponentInterface.open(bus, "ticker", component, quiet));
                opened.getFirst().answer(NEXT, tick -> Promise.of(new Tick(tick.number() + 1)));
                user.add(bus.attach("user"));
            });
            var ticker = opened.getFirst();
            var gone = new AtomicBoolean(true);
            for (int step = 0; step < 80; step++) {
                switch (random.nextInt(6)) {
                    case 0 -> {
                        if (gone.getAndSet(false)) {
                            test.run(() ->
                                    ignore(broker.register("ticker", List.of(), ticker.address(), ticker::newLife)));
                        }
                        test.run(() -> ignore(broker.require(Need.ofService("user", "ticker"))));
                    }
                    case 1 ->
                        test.run(() -> broker.withdraw(ticker.address())
                                .handle((done, error) -> gone.compareAndSet(false, error == null)));
                    case 2 ->
                        test.run(() -> ignore(
                                user.getFirst().ask(ticker.address(), NEXT, new Tick(1), Duration.ofSeconds(1))));
                    case 3 -> test.advance(Duration.ofMillis(100 + random.nextInt(900)));
                    default -> test.run(communication::act);
                }
            }
            test.run(ticker::close);
            test.run(bus::close);
            test.space().close();
            test.takeProblems();
            test.takeDeadLetters();
        }
        return monitor;
    }

    @Test
    void flakyComponents_andTheirRequests_conform_andEachStepThatTheyNeedWouldBeMissed() {
        var components = new Conformance(LifecycleWirings.PROVIDER.wiring(), LifecycleWirings.PROVIDER.steps());
        var requests = new Conformance(LifecycleWirings.REQUEST.wiring(), LifecycleWirings.REQUEST.steps());
        for (int seed = 1; seed <= SEEDS; seed++) {
            var monitor = flakyComponent(seed);
            monitor.check();
            monitor.runs(LifecycleWirings.PROVIDER).forEach(components::add);
            monitor.runs(LifecycleWirings.REQUEST).forEach(requests::add);
        }
        assertThat(requests.unused()).as("steps that no run takes").isEmpty();
        assertThat(components.used()).extracting(Object::toString).anyMatch(step -> step.contains("sends"));
        for (var runs : List.of(components, requests)) {
            assertThat(runs.problems()).isEmpty();
            assertThat(runs.used())
                    .allSatisfy(step -> assertThat(runs.without(step))
                            .as("the declaration without " + step)
                            .isPresent());
        }
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
    void providerThatRunsWithoutBeingStarted_isFound() {
        var monitor = new AppMonitor();
        monitor.onBroker(new BrokerEvent.Registered(CLOCK));
        monitor.onBroker(new BrokerEvent.Started(CLOCK));
        assertThatThrownBy(monitor::check)
                .hasMessageContaining("provider test/clock: provider: has started is not allowed: provider is in"
                        + " \"idle\", where it may do \"is being started\"");
    }

    @Test
    void valueOfAComponentThatWasStopped_isFound() {
        var monitor = new AppMonitor();
        var bus = monitor.bus(BusObserver.logging());
        var value = new BusMessage.Data(CLOCK.provider(), new Purpose.Publication("lamps"), 2, new Nothing());
        monitor.onBroker(new BrokerEvent.Registered(CLOCK));
        monitor.onBroker(new BrokerEvent.Starting(CLOCK));
        monitor.onBroker(new BrokerEvent.Started(CLOCK));
        bus.passed(value);
        monitor.check();
        monitor.onBroker(new BrokerEvent.Stopped(CLOCK));
        bus.passed(
                new BusMessage.Data(new Address("test", "other"), new Purpose.Publication("lamps"), 1, new Nothing()));
        monitor.check();
        bus.passed(value);
        assertThatThrownBy(monitor::check)
                .hasMessageContaining("provider test/clock: provider: sends is not allowed: provider is in \"idle\"");
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
