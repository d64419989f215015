package hello;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.Promise;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Need;
import io.troupe.bus.BusException;
import io.troupe.bus.BusSettings;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import java.time.Duration;
import java.util.List;
import java.util.Optional;

/** An actor as a service: published by one part of a program, found and called by another, here and over hosts. */
public final class HelloService {
    private static final Duration LIMIT = Duration.ofSeconds(10);

    public interface Greeter {
        Promise<String> greet(String name);
    }

    /** The argument is the address of a NATS server; else it is in the variable NATS_URL, or on this machine. */
    public static void main(String[] args) throws Exception {
        inOneProcess();
        String server = args.length > 0
                ? args[0]
                : Optional.ofNullable(System.getenv("NATS_URL")).orElse("nats://127.0.0.1:4222");
        try {
            overHosts(server);
        } catch (BusException noServer) {
            System.out.println("not over hosts: " + noServer.getMessage());
        }
    }

    private static void inOneProcess() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("ship"))) {
            var broker = Broker.open(space, BrokerSettings.defaults());
            var services = broker.services();
            publish(services, space);
            System.out.println("in one process: " + call(services));
            broker.close(); // stops the actor
        }
    }

    /** Two nodes on one bus. They could be two programs, on two machines: nothing else would change. */
    private static void overHosts(String server) throws Exception {
        try (var ship = ActorSpace.create(SpaceSettings.named("ship"));
                var shore = ActorSpace.create(SpaceSettings.named("shore"));
                var shipBus = NatsBus.open("ship", NatsSettings.at(server), BusSettings.on(ship));
                var shoreBus = NatsBus.open("shore", NatsSettings.at(server), BusSettings.on(shore))) {
            var shipBroker = Broker.over(shipBus, ship, BrokerSettings.defaults());
            publish(shipBroker.services(), ship);
            var shoreBroker = Broker.over(shoreBus, shore, BrokerSettings.defaults());
            var guest = shoreBroker.services();
            System.out.println("over hosts: " + call(guest));
            shoreBroker.close();
            shipBroker.close();
        }
    }

    /** The service "greeter" with the capability "greeting". The broker starts the actor when it is needed. */
    private static void publish(ActorServices services, ActorSpace space) {
        var capabilities = List.of("greeting");
        services.publish(space, Greeter.class, "greeter", capabilities, () -> name -> Promise.of("Hello, " + name));
    }

    /** Needs a greeting from any provider; the call waits for a provider for at most 5 seconds. */
    private static String call(ActorServices services) throws Exception {
        try (var connection = services.connect(Greeter.class, Need.ofCapability("guest", "greeting"))) {
            return connection.actor().greet("Ada").get(LIMIT);
        }
    }
}
