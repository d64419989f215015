package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Need;
import io.troupe.bus.BusSettings;
import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Compiles the samples of the guide "Over hosts", and runs the first two in two processes at a real server. */
@Tag("threads")
@Timeout(value = 180, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class HostsGuideTest {
    private final List<Object> shown = new ArrayList<>();

    interface Greeter {
        Promise<String> greet(String name);
    }

    /** The program on one host; it ends with its standard input. */
    static final class Ship {
        public static void main(String[] arguments) throws IOException {
            String address = arguments[0];

            var space = ActorSpace.create(SpaceSettings.named("ship"));
            var bus = NatsBus.open("ship", NatsSettings.at(address), BusSettings.on(space));
            var broker = Broker.over(bus, space, BrokerSettings.defaults());
            var services = broker.services();
            services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));

            System.in.read();
            System.exit(0);
        }
    }

    /** The program on the other host. */
    private void shore(String address) throws Exception {
        var space = ActorSpace.create(SpaceSettings.named("shore"));
        var bus = NatsBus.open("shore", NatsSettings.at(address), BusSettings.on(space));
        var broker = Broker.over(bus, space, BrokerSettings.defaults());
        var services = broker.services();
        var greeter = services.connect(Greeter.class, Need.ofService("guest", "greeter"))
                .actor();
        show(greeter.greet("Ada").get(Duration.ofSeconds(10)));

        bus.close();
        space.close();
    }

    private void show(Object what) {
        shown.add(what);
    }

    @Test
    void actorOfOneProcess_isCalledByAnother() throws Exception {
        try (var server = NatsServer.start()) {
            var ship = startShip(server.address());
            try {
                awaitOffers(server.address());
                shore(server.address());
            } finally {
                ship.destroyForcibly();
            }
        }
        assertThat(shown).containsExactly("hello Ada");
    }

    private static Process startShip(String address) throws IOException {
        Path java = Path.of(System.getProperty("java.home"), "bin", "java");
        return new ProcessBuilder(
                        java.toString(), "-cp", System.getProperty("java.class.path"), Ship.class.getName(), address)
                .inheritIO()
                .redirectInput(ProcessBuilder.Redirect.PIPE)
                .start();
    }

    /** A machine may need longer to start a JVM than a caller waits for a provider. */
    private static void awaitOffers(String address) throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("probe"));
                var bus = NatsBus.open("probe", NatsSettings.at(address), BusSettings.on(space))) {
            var broker = Broker.over(bus, space, BrokerSettings.defaults());
            while (broker.registered().get(Duration.ofSeconds(60)).isEmpty()) {
                Thread.sleep(20);
            }
        }
    }
}
