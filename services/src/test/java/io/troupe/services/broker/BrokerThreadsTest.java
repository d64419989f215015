package io.troupe.services.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Address;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Executors;
import org.junit.jupiter.api.Test;

/** Broker, providers and callers on spaces, and so threads, of their own. */
class BrokerThreadsTest {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final Need PARROT = Need.ofService("robot 1", "parrot");

    private final List<BrokerEvent> events = Collections.synchronizedList(new ArrayList<>());

    private static ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name).withOnStall(Duration.ZERO, stall -> {}));
    }

    @Test
    void spaceThatHangs_isNoticedByABrokerOnAnother_andItsUsersGoOver() throws Exception {
        var release = new CountDownLatch(1);
        try (var brokers = space("brokers");
                var hanging = space("hanging");
                var other = space("other")) {
            var broker = ServiceBroker.open(
                    brokers,
                    BrokerSettings.DEFAULT
                            .withChecks(Duration.ofMillis(10), Duration.ofMillis(500), 3)
                            .withLimits(Duration.ofSeconds(30), Duration.ofMillis(500), Duration.ofSeconds(1))
                            .withObserver(events::add));
            var services = new ActorServices(broker, "node", brokers, events::add);
            var diary = Collections.synchronizedList(new ArrayList<String>());
            services.publish(hanging, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey("a", diary))
                    .get(PATIENCE);
            services.publish(other, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey("b", diary))
                    .get(PATIENCE);
            var overThere = new CompletableFuture<String>();
            broker.connect(PARROT, new Broker.Connection() {
                @Override
                public void use(ServiceRecord provider) {
                    if (provider.provider().name().equals("parrot-2")) {
                        overThere.complete(provider.provider().name());
                    }
                }

                @Override
                public void lost(MissingServiceException why) {}
            });
            var connection = services.connect(Parrot.class, PARROT);
            assertThat(connection.actor().say("1").get(PATIENCE)).isEqualTo("a: 1");
            hanging.execute(() -> awaitUninterrupted(release));
            assertThat(overThere.get(60, java.util.concurrent.TimeUnit.SECONDS)).isEqualTo("parrot-2");
            connection.close();
            try (var again = services.connect(Parrot.class, PARROT)) {
                assertThat(again.actor().say("2").get(PATIENCE)).isEqualTo("b: 2");
            }
            release.countDown();
            assertThat(broker.shutDown().get(PATIENCE)).isEmpty();
            assertThat(events).anyMatch(BrokerEvent.Suspect.class::isInstance);
        } finally {
            release.countDown();
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
            var broker = ServiceBroker.open(brokers, BrokerSettings.DEFAULT.withObserver(events::add));
            var services = new ActorServices(broker, "node", callers, events::add);
            var diary = Collections.synchronizedList(new ArrayList<String>());
            Address now = services.publish(
                            providers, Parrot.class, "parrot", List.of(), () -> new Parrot.Grey("0", diary))
                    .get(PATIENCE)
                    .provider();
            var parrot = services.connect(Parrot.class, PARROT, ConnectionSettings.DEFAULT.withAnswerLimit(PATIENCE))
                    .actor();
            var load = threads.submit(() -> {
                List<Promise<String>> answers = new ArrayList<>();
                for (int i = 0; i < calls; i++) {
                    answers.add(parrot.say(String.valueOf(i)));
                    if (i % 100 == 99) {
                        answers.getLast().get(PATIENCE); // so that the load lasts as long as the replacing
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
