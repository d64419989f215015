package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Executors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Broker, providers and callers on separate spaces, each with a thread. */
@Timeout(600)
class BrokerThreadsTest {
    private static final Duration PATIENCE = Patience.LONG;
    private static final Need PARROT = Need.ofService("robot 1", "parrot");

    private final List<BrokerEvent> events = Collections.synchronizedList(new ArrayList<>());

    private static ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name).withOnStall(Duration.ZERO, stall -> {}));
    }

    /** Cranks the broker's space until work on other threads has settled the promise. */
    private static <T> T await(TestSpace brokers, Promise<T> promise) {
        while (!promise.isDone()) {
            brokers.crank();
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
            var broker = Broker.open(brokers.space(), BrokerSettings.DEFAULT.withObserver(events::add));
            var services = new ActorServices(broker, "node", brokers.space(), events::add);
            var diary = Collections.synchronizedList(new ArrayList<String>());
            await(
                    brokers,
                    services.publish(hanging, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey("a", diary)));
            await(
                    brokers,
                    services.publish(other, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey("b", diary)));
            var overThere = new Deferred<String>(brokers.space());
            broker.connect(PARROT, new Broker.Connection() {
                @Override
                public void use(ServiceRecord provider) {
                    if (provider.provider().name().equals("parrot-2")) {
                        overThere.resolve(provider.provider().name());
                    }
                }

                @Override
                public void lost(MissingServiceException why) {}
            });
            var connection = services.connect(Parrot.class, PARROT);
            assertThat(await(brokers, connection.actor().say("1"))).isEqualTo("a: 1");
            hanging.execute(() -> {
                hangs.countDown();
                awaitUninterrupted(release);
            });
            hangs.await();
            while (events.stream().noneMatch(BrokerEvent.Failed.class::isInstance)) {
                brokers.crank();
                brokers.advance(Duration.ofSeconds(1));
            }
            assertThat(events).anyMatch(BrokerEvent.Suspect.class::isInstance);
            assertThat(await(brokers, overThere)).isEqualTo("parrot-2");
            connection.close();
            try (var again = services.connect(Parrot.class, PARROT)) {
                assertThat(await(brokers, again.actor().say("2"))).isEqualTo("b: 2");
            }
            release.countDown();
            assertThat(await(brokers, broker.shutDown())).isEmpty();
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
            var broker = Broker.open(brokers, Patience.BROKER.withObserver(events::add));
            var services = new ActorServices(broker, "node", callers, events::add);
            var diary = Collections.synchronizedList(new ArrayList<String>());
            Address now = services.publish(
                            providers, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey("0", diary))
                    .get(PATIENCE)
                    .provider();
            var parrot =
                    services.connect(Parrot.class, PARROT, Patience.CONNECTION).actor();
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
                String name = String.valueOf(i);
                now = services.replace(
                                now, providers, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey(name, diary))
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
            assertThat(broker.shutDown().get(PATIENCE)).isEmpty();
        }
    }
}
