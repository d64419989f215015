package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * Two actors that are publisher and subscriber of each other, over a broker. All three run on separate spaces, each
 * with a thread.
 */
@Timeout(600)
class MutualThreadsTest {
    private static final Duration PATIENCE = Patience.LONG;

    /** Publishes numbers to its followers. */
    interface Station {
        Promise<@Nullable Void> follow(String by, Callback<Integer> reader);

        void publish(int number);

        void die();
    }

    private final BlockingQueue<String> diary = new LinkedBlockingQueue<>();

    /** Follows the current provider of another service, and publishes the successor of each number that it receives. */
    private final class Answerer extends Actor implements Station, Broker.Connection {
        private final String name;
        private final Need other;
        private final int last;
        private final ActorServices services;
        private final List<Callback<Integer>> readers = new ArrayList<>();
        private @Nullable ActorConnection<Station> connection;

        Answerer(String name, String other, int last, ActorServices services) {
            this.name = name;
            this.other = Need.ofService(name, other);
            this.last = last;
            this.services = services;
        }

        @Override
        protected void started() {
            var opened = services.connect(Station.class, other, Patience.CONNECTION);
            connection = opened;
            opened.whenReady() // so that the connection is notified of each provider before this actor
                    .thenCompose(ready -> services.broker().connect(other, this))
                    .exceptionally(error -> {
                        diary.add(name + " is not connected: " + error);
                        throw new IllegalStateException(error);
                    });
        }

        @Override
        public void use(ServiceRecord provider) {
            String publisher = provider.provider().name();
            if (connection != null) {
                connection
                        .actor()
                        .follow(name, (number, error) -> hear(publisher, number))
                        .handle((followed, error) -> diary.add(name + " follows " + publisher));
            }
        }

        @Override
        public void lost(MissingServiceException why) {
            diary.add(name + " has lost " + why.getMessage());
        }

        private void hear(String publisher, @Nullable Integer number) {
            diary.add(name + " hears " + number + " from " + publisher);
            if (number != null && number % 100 < last) {
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
            stop();
        }

        @Override
        protected void stopped() {
            services.broker().disconnect(this);
            if (connection != null) {
                connection.close();
            }
        }
    }

    private static ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name).withOnStall(Duration.ZERO, stall -> {}));
    }

    /** Waits until exactly these entries have been recorded, in any order. */
    private void await(String... entries) throws InterruptedException {
        Set<String> missing = new LinkedHashSet<>(Arrays.asList(entries));
        while (!missing.isEmpty()) {
            String next = diary.poll(PATIENCE.toSeconds(), TimeUnit.SECONDS);
            assertThat(missing).as("what was awaited when this came").contains(String.valueOf(next));
            missing.remove(next);
        }
    }

    @Test
    void publisherAndSubscriberOfEachOther_onThreeThreads_goOnAfterAFailoverOfOne() throws Exception {
        try (var brokers = space("brokers");
                var left = space("left");
                var right = space("right")) {
            Broker broker =
                    Broker.open(brokers, Patience.BROKER.withoutRestart().withObserver(event -> {}));
            var services = new ActorServices(broker, "node", brokers, event -> {});
            services.publish(left, Station.class, "a", List.of(), () -> new Answerer("a", "b", 4, services));
            services.publish(right, Station.class, "b", List.of(), () -> new Answerer("b", "a", 4, services));
            services.publish(right, Station.class, "b", List.of(), () -> new Answerer("b-2", "a", 4, services));

            try (var a = services.connect(Station.class, Need.ofService("test", "a"), Patience.CONNECTION);
                    var b = services.connect(Station.class, Need.ofService("test", "b"), Patience.CONNECTION)) {
                await("a follows b", "b follows a"); // connecting to one starts both
                a.actor().publish(1);
                await("b hears 1 from a", "a hears 2 from b", "b hears 3 from a", "a hears 4 from b");

                b.actor().die();
                await("a follows b-2", "b-2 follows a");
                a.actor().publish(101);
                await("b-2 hears 101 from a", "a hears 102 from b-2", "b-2 hears 103 from a", "a hears 104 from b-2");
                b.actor().publish(204);
                await("a hears 204 from b-2");
            }
            assertThat(broker.shutDown().get(PATIENCE)).isEmpty();
            assertThat(diary).noneMatch(entry -> entry.contains("hears"));
        }
    }
}
