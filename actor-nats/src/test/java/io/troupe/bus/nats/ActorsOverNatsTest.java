package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorConnection;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceCallException;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.RemoteFailure;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Actors as services of several processes over a real server. */
@Tag("threads")
@Timeout(value = 240, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class ActorsOverNatsTest {
    interface Greeter {
        Promise<String> greet(String name);

        void count(int to, Callback<Integer> callback);
    }

    /** Greets with the name of its process. */
    private record GreeterActor(String process) implements Greeter {
        @Override
        public Promise<String> greet(String name) {
            return name.isEmpty()
                    ? Promise.failed(new IllegalArgumentException("no name"))
                    : Promise.of("hello " + name + " from " + process);
        }

        @Override
        public void count(int to, Callback<Integer> callback) {
            for (int i = 1; i <= to; i++) {
                callback.next(i);
            }
            callback.finish();
        }
    }

    private static final Duration LONG = Duration.ofSeconds(60);
    private static final Need GREETER = Need.ofService("guest", "greeter");
    private static final ConnectionSettings PATIENT =
            ConnectionSettings.defaults().withWaitLimit(LONG).withAnswerLimit(LONG);

    private final List<Process> open = new ArrayList<>();

    /** What one process has. */
    private static final class Process {
        final String name;
        final ActorSpace space;
        final Bus bus;
        final Broker broker;
        final ActorServices services;

        Process(String name, NatsServer server) {
            this.name = name;
            this.space = ActorSpace.create(SpaceSettings.named(name));
            this.bus = NatsBus.open(
                    name,
                    NatsSettings.at(server.address()),
                    BusSettings.on(space).withObserver(loss -> {}));
            this.broker = Broker.over(bus, space, BrokerSettings.defaults().withObserver(event -> {}));
            this.services = broker.services();
        }

        void publish() throws Exception {
            services.publish(space, Greeter.class, "greeter", List.of(), () -> new GreeterActor(name))
                    .get(LONG);
        }

        void die() {
            bus.close();
            space.close();
        }
    }

    private Process process(String name, NatsServer server) {
        var process = new Process(name, server);
        open.add(process);
        return process;
    }

    @AfterEach
    void closeAll() {
        open.forEach(Process::die);
    }

    @Test
    void actor_isStartedCalledAndFollowedByAnother_acrossProcesses() throws Exception {
        try (var server = NatsServer.start()) {
            var ship = process("ship", server);
            ship.publish();
            var shore = process("shore", server);
            shore.publish();
            var guest = process("guest", server);
            ActorConnection<Greeter> connection = guest.services.connect(Greeter.class, GREETER, PATIENT);
            Greeter greeter = connection.actor();
            String first = greeter.greet("Ada").get(LONG);
            assertThat(first).isIn("hello Ada from ship", "hello Ada from shore");
            var failure = greeter.greet("");
            assertThatThrownBy(() -> failure.get(LONG))
                    .isInstanceOf(RemoteFailure.class)
                    .hasMessageEndingWith(": java.lang.IllegalArgumentException: no name");

            var counted = new CopyOnWriteArrayList<Integer>();
            var end = new CompletableFuture<String>();
            greeter.count(1_000, new Callback.Stream<>(counted::add, error -> end.complete(String.valueOf(error))));
            assertThat(end.get(60, TimeUnit.SECONDS)).isEqualTo("null");
            assertThat(counted).hasSize(1_000).isSorted();

            var dying = first.endsWith("ship") ? ship : shore;
            open.remove(dying);
            dying.die();
            String other = first.endsWith("ship") ? "hello Bob from shore" : "hello Bob from ship";
            assertThat(greetUntilAnswered(greeter)).isEqualTo(other);
        }
    }

    /**
     * Repeats a call while the client is being moved to the other provider. A call that was under way when the end of
     * its provider was noticed counts as sent, any other as not sent.
     */
    private static String greetUntilAnswered(Greeter greeter) throws Exception {
        while (true) {
            try {
                return greeter.greet("Bob").get(LONG);
            } catch (ServiceCallException unanswered) {
                assertThat(unanswered.mayHaveRun())
                        .as(unanswered.getMessage())
                        .isEqualTo(unanswered.getMessage().contains(" ended while "));
            }
        }
    }
}
