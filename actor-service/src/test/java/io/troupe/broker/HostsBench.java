package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BytePipe;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;

/** Several processes on one space without a thread, which exchange bytes. Tests extend it. */
class HostsBench {
    static final Need PARROT = Need.ofService("robot 1", "parrot");
    static final OfferMessages MESSAGES = new OfferMessages("");

    final TestSpace test = new TestSpace();
    final BytePipe pipe = new BytePipe(test.space());
    final List<String> diary = new ArrayList<>(); // of all parrots
    final List<String> losses = new ArrayList<>(); // of all buses
    final Map<String, Host> hosts = new LinkedHashMap<>();

    /** One process. */
    final class Host {
        final String name;
        final List<BrokerEvent> events = new ArrayList<>();
        final Bus bus;
        final Broker broker;
        final ActorServices services;
        final Map<String, Parrot.Grey> parrots = new LinkedHashMap<>();

        Host(String name, BrokerSettings settings, int rank) {
            this(name, settings, Sharing.defaults().withRank(rank));
        }

        Host(String name, BrokerSettings settings, Sharing sharing) {
            this.name = name;
            this.bus =
                    pipe.open(name, BusSettings.on(test.space()).withObserver(loss -> losses.add(name + ": " + loss)));
            this.broker = Broker.over(bus, test.space(), settings.withObserver(events::add), sharing);
            this.services = broker.services();
            hosts.put(name, this);
        }

        Parrot.Grey parrot(String parrotName) {
            var parrot = new Parrot.Grey(parrotName, diary);
            parrots.put(parrotName, parrot);
            diary.add(parrotName + " is made");
            return parrot;
        }

        void publish(String parrotName) {
            get(services.publish(test.space(), Parrot.class, "parrot", List.of("talks"), () -> parrot(parrotName)));
        }

        void kill(String portName) {
            test.space().stop(services.running(new Address(name, portName)).proxy());
        }

        ActorConnection<Parrot> connect(ConnectionSettings settings) {
            return services.connect(Parrot.class, PARROT, settings);
        }

        Parrot connected() {
            return connect(ConnectionSettings.defaults()).actor();
        }

        /** The health of a provider in the eyes of this process. */
        @Nullable
        Health health(String address) {
            return get(broker.registered()).stream()
                    .filter(each -> each.provider().toString().equals(address))
                    .map(ServiceRecord::health)
                    .findFirst()
                    .orElse(null);
        }

        List<String> found() {
            return get(broker.find(PARROT)).stream()
                    .map(each -> each.provider().toString())
                    .toList();
        }

        <E extends BrokerEvent> List<E> events(Class<E> type) {
            return events.stream().filter(type::isInstance).map(type::cast).toList();
        }

        /** The process ends without a word. */
        void die() {
            bus.close();
            hosts.remove(name);
            get(broker.closeAsync());
        }
    }

    final Host host(String name) {
        var host = new Host(name, BrokerSettings.defaults().withoutRestart(), 0);
        test.runQueued();
        return host;
    }

    @AfterEach
    void close() {
        hosts.values().forEach(host -> get(host.broker.closeAsync()));
        test.runQueued();
        hosts.values().forEach(host -> host.bus.close());
        test.runQueued();
        test.close();
    }

    final <T extends @Nullable Object> T get(Promise<T> promise) {
        return test.get(promise);
    }

    final void seconds(int count) {
        for (int i = 0; i < count; i++) {
            test.runQueued();
            test.advance(Duration.ofSeconds(1));
        }
    }

    final void assertCallError(Promise<?> call, boolean mayHaveRun, String message) {
        assertThat(test.error(call))
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun())
                                .as(error.getMessage())
                                .isEqualTo(mayHaveRun))
                .hasMessage(message);
    }
}
