package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Executors;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Broker, providers and callers on separate spaces, each with a thread. */
@Timeout(600)
class BrokerThreadsTest {
    /** A limit that a busy machine does not reach. A test that hangs is ended by its JUnit timeout. */
    private static final Duration PATIENCE = Duration.ofMinutes(10);

    private static final BrokerSettings PATIENT_BROKER = BrokerSettings.defaults()
            .withCheckEvery(PATIENCE)
            .withCheckLimit(PATIENCE)
            .withMissedChecks(3)
            .withStartLimit(PATIENCE)
            .withStopLimit(PATIENCE)
            .withNotifyLimit(PATIENCE);
    private static final ConnectionSettings PATIENT = ConnectionSettings.defaults()
            .withWaitLimit(PATIENCE)
            .withAnswerLimit(PATIENCE)
            .withOneWayLimit(PATIENCE);
    /** A provider whose stop is answered when the test does. */
    private record Anchor(CountDownLatch stopping, Deferred<@Nullable Void> stopped) implements Provider {
        Anchor() {
            this(new CountDownLatch(1), Deferred.unbound());
        }

        @Override
        public Promise<@Nullable Void> start() {
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> stop() {
            stopping.countDown();
            return stopped;
        }

        @Override
        public Promise<@Nullable Void> check() {
            return Promise.done();
        }
    }

    private static Anchor anchored(Broker broker) throws Exception {
        var anchor = new Anchor();
        broker.register("anchor", List.of(), new Address("node", "anchor"), anchor)
                .get(PATIENCE);
        broker.require(Need.ofService("ship", "anchor")).get(PATIENCE);
        return anchor;
    }

    @Test
    void close_waitsUntilTheProvidersHaveStopped() throws Exception {
        try (var brokers = space("brokers")) {
            var broker = Broker.open("node", brokers, PATIENT_BROKER.withObserver(events::add));
            var anchor = anchored(broker);
            var closing = new Thread(broker::close, "closing");
            closing.start();
            anchor.stopping().await();
            while (closing.getState() != Thread.State.TIMED_WAITING) {
                assertThat(closing.isAlive()).isTrue();
                Thread.onSpinWait();
            }
            anchor.stopped().resolve(null);
            closing.join();
            assertThat(broker.registered().get(PATIENCE))
                    .extracting(ServiceRecord::health)
                    .containsExactly(Health.STOPPED);
        }
    }

    @Test
    void close_onTheThreadOfASpace_doesNotWait() throws Exception {
        try (var brokers = space("brokers");
                var other = space("other")) {
            var broker = Broker.open("node", brokers, PATIENT_BROKER.withObserver(events::add));
            var anchor = anchored(broker);
            Deferred<String> returned = Deferred.unbound();
            other.execute(() -> {
                broker.close();
                returned.resolve("returned");
            });
            assertThat(returned.get(PATIENCE)).isEqualTo("returned");
            anchor.stopped().resolve(null);
            assertThat(broker.closeAsync().get(PATIENCE)).isEmpty();
        }
    }

    private static final Need PARROT = Need.ofService("robot 1", "parrot");

    private final List<BrokerEvent> events = Collections.synchronizedList(new ArrayList<>());
    private final List<String> diary = Collections.synchronizedList(new ArrayList<>());
    private final BlockingQueue<String> news = new LinkedBlockingQueue<>();

    private static ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name).withoutStallLimit());
    }

    private Promise<ServiceRecord> publish(ActorServices services, ActorSpace space, String name) {
        return services.publish(space, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey(name, diary));
    }

    /** Runs the broker's space until work on other threads has settled the promise. */
    private static <T> T await(TestSpace brokers, Promise<T> promise) {
        while (!promise.isDone()) {
            brokers.runQueued();
            Thread.yield();
        }
        return brokers.get(promise);
    }

    @Test
    void spaceThatHangs_isNoticedByABrokerOnAnother_andItsUsersGoOver() throws Exception {
        var hangs = new CountDownLatch(1);
        var release = new CountDownLatch(1);
        var brokers = new TestSpace(); // its clock decides when a limit is over
        try (var hanging = space("hanging");
                var other = space("other")) {
            var broker = Broker.open(
                    "node", brokers.space(), BrokerSettings.defaults().withObserver(events::add));
            var services = broker.services();
            await(brokers, publish(services, hanging, "a"));
            await(brokers, publish(services, other, "b"));
            Deferred<String> overThere = brokers.space().deferred();
            broker.connect(PARROT, (ScriptedBroker.Client) provider -> {
                if (provider.provider().name().equals("parrot#2")) {
                    overThere.resolve(provider.provider().name());
                }
            });
            var connection = services.connect(Parrot.class, PARROT);
            assertThat(await(brokers, connection.actor().say("1"))).isEqualTo("a: 1");
            hanging.execute(() -> {
                hangs.countDown();
                awaitUninterrupted(release);
            });
            hangs.await();
            while (events.stream().noneMatch(BrokerEvent.Failed.class::isInstance)) {
                brokers.runQueued();
                brokers.advance(Duration.ofSeconds(1));
            }
            assertThat(events).anyMatch(BrokerEvent.Suspect.class::isInstance);
            assertThat(await(brokers, overThere)).isEqualTo("parrot#2");
            connection.close();
            try (var again = services.connect(Parrot.class, PARROT)) {
                assertThat(await(brokers, again.actor().say("2"))).isEqualTo("b: 2");
            }
            release.countDown();
            assertThat(await(brokers, broker.closeAsync())).isEmpty();
        } finally {
            release.countDown();
            brokers.close();
        }
    }

    private static void awaitUninterrupted(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    @Test
    void providersReplacedUnderLoad_answerEveryCallOnce_andNoneIsRefused() throws Exception {
        int calls = 4000;
        int replacements = 25;
        try (var brokers = space("brokers");
                var providers = space("providers");
                var callers = space("callers");
                var threads = Executors.newVirtualThreadPerTaskExecutor()) {
            var broker = Broker.open(brokers, PATIENT_BROKER.withObserver(events::add));
            var services = new ActorServices(broker, "node", callers, events::add, null);
            var now = publish(services, providers, "0").get(PATIENCE).provider();
            var parrot = services.connect(Parrot.class, PARROT, PATIENT).actor();
            var load = threads.submit(() -> {
                List<Promise<String>> answers = new ArrayList<>();
                for (int i = 0; i < calls; i++) {
                    answers.add(parrot.say(String.valueOf(i)));
                    if (i % 100 == 99) {
                        answers.getLast().get(PATIENCE); // keeps the load running during all replacements
                    }
                }
                return Promise.all(answers).get(PATIENCE);
            });
            for (int i = 1; i <= replacements; i++) {
                var next = new Parrot.Grey(String.valueOf(i), diary);
                now = services.replace(now, providers, Parrot.class, "parrot", List.of(), () -> next)
                        .get(PATIENCE)
                        .provider();
            }
            List<String> answers = load.get();
            assertThat(answers).hasSize(calls);
            for (int i = 0; i < calls; i++) {
                assertThat(answers.get(i)).endsWith(": " + i);
            }
            assertThat(diary).hasSize(calls);
            assertThat(diary.stream().map(each -> each.substring(each.lastIndexOf(' ') + 1)))
                    .doesNotHaveDuplicates();
            assertThat(events.stream().filter(BrokerEvent.Replaced.class::isInstance))
                    .hasSize(replacements);
            assertThat(events)
                    .noneMatch(event -> event instanceof BrokerEvent.Late || event instanceof BrokerEvent.UserFailed);
            assertThat(broker.closeAsync().get(PATIENCE)).isEmpty();
        }
    }

    // ---- two actors that are publisher and subscriber of each other

    /** Publishes numbers to its followers. */
    interface Station {
        Promise<@Nullable Void> follow(String by, Callback<Integer> reader);

        void publish(int number);

        void die();
    }

    /** Follows the current provider of another service, and publishes the successor of each number that it receives. */
    private final class Answerer extends Actor implements Station, ScriptedBroker.Client {
        private final String name;
        private final Need other;
        private final ActorServices services;
        private final List<Callback<Integer>> readers = new ArrayList<>();
        private @Nullable ActorConnection<Station> connection;

        Answerer(String name, String other, ActorServices services) {
            this.name = name;
            this.other = Need.ofService(name, other);
            this.services = services;
        }

        @Override
        protected void started() {
            var opened = services.connect(Station.class, other, PATIENT);
            connection = opened;
            opened.whenReady() // so that the connection is notified of each provider before this actor
                    .thenCompose(ready -> services.broker().connect(other, this))
                    .exceptionally(error -> {
                        news.add(name + " is not connected: " + error);
                        throw new IllegalStateException(error);
                    });
        }

        @Override
        public void use(ServiceRecord provider) {
            String publisher = provider.provider().name();
            if (connection != null) {
                connection
                        .actor()
                        .follow(name, (number, error) -> read(publisher, number))
                        .handle((followed, error) -> news.add(name + " follows " + publisher));
            }
        }

        @Override
        public void lost(MissingServiceException why) {
            news.add(name + " has lost " + why.getMessage());
        }

        private void read(String publisher, @Nullable Integer number) {
            news.add(name + " reads " + number + " from " + publisher);
            if (number != null && number % 100 < 4) {
                publish(number + 1);
            }
        }

        @Override
        public Promise<@Nullable Void> follow(String by, Callback<Integer> reader) {
            readers.add(reader);
            return Promise.done();
        }

        @Override
        public void publish(int number) {
            readers.forEach(reader -> reader.next(number));
        }

        @Override
        public void die() {
            context().stop();
        }

        @Override
        protected void stopped() {
            services.broker().disconnect(this);
            if (connection != null) {
                connection.close();
            }
        }
    }

    /** Waits until exactly these entries have been recorded, in any order. */
    private void await(String... entries) throws InterruptedException {
        var missing = new LinkedHashSet<>(Arrays.asList(entries));
        while (!missing.isEmpty()) {
            String next = news.poll(PATIENCE.toSeconds(), TimeUnit.SECONDS);
            assertThat(missing).as("what was awaited when this came").contains(String.valueOf(next));
            missing.remove(next);
        }
    }

    @Test
    void publisherAndSubscriberOfEachOther_onThreeThreads_goOnAfterAFailoverOfOne() throws Exception {
        try (var brokers = space("brokers");
                var left = space("left");
                var right = space("right")) {
            var broker =
                    Broker.open("node", brokers, PATIENT_BROKER.withoutRestart().withObserver(event -> {}));
            var services = broker.services();
            services.publish(left, Station.class, "a", List.of(), () -> new Answerer("a", "b", services));
            services.publish(right, Station.class, "b", List.of(), () -> new Answerer("b", "a", services));
            services.publish(right, Station.class, "b", List.of(), () -> new Answerer("b#2", "a", services));

            try (var a = services.connect(Station.class, Need.ofService("test", "a"), PATIENT);
                    var b = services.connect(Station.class, Need.ofService("test", "b"), PATIENT)) {
                await("a follows b", "b follows a"); // connecting to one starts both
                a.actor().publish(1);
                await("b reads 1 from a", "a reads 2 from b", "b reads 3 from a", "a reads 4 from b");

                b.actor().die();
                await("a follows b#2", "b#2 follows a");
                a.actor().publish(101);
                await("b#2 reads 101 from a", "a reads 102 from b#2", "b#2 reads 103 from a", "a reads 104 from b#2");
                b.actor().publish(204);
                await("a reads 204 from b#2");
            }
            assertThat(broker.closeAsync().get(PATIENCE)).isEmpty();
            assertThat(news).noneMatch(entry -> entry.contains("reads"));
        }
    }

    @Test
    void close_ofABrokerWhoseSpaceIsBusy_endsWithAnErrorAfterItsLimits_andGoesOn() throws Exception {
        Duration shortest = Duration.ofMillis(1);
        var settings = BrokerSettings.defaults()
                .withStartLimit(shortest)
                .withStopLimit(shortest)
                .withNotifyLimit(shortest);
        try (var space = ActorSpace.create(SpaceSettings.named("busy").withoutStallLimit())) {
            var broker = Broker.open("here", space, settings);
            var free = new CountDownLatch(1);
            space.execute(() -> awaitIt(free));
            assertThatThrownBy(broker::close)
                    .isInstanceOf(ProviderException.class)
                    .hasMessageMatching("the broker has not been closed within PT0[.0-9]+S; it goes on");
            free.countDown();
            broker.closeAsync().get(PATIENCE);
        }
    }

    private static void awaitIt(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException interrupted) {
            throw new AssertionError(interrupted);
        }
    }
}
