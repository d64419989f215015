package io.troupe.services.component;

import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.function.Function;

/**
 * The bus communication unit (BCU): connects a component interface with the bus.
 *
 * <p><b>Role.</b> Publishes data messages, subscribes to topics, and answers requests for data.
 *
 * <p><b>Threads.</b> The actor space on which it was attached.
 *
 * <p><b>Source.</b> Paper, section 2.2.2.3.
 */
public final class BusCommunication implements AutoCloseable {
    private final BusPort port;
    private final List<BusPort.Subscription> subscriptions = new ArrayList<>();

    private BusCommunication(BusPort port) {
        this.port = port;
    }

    static BusCommunication attach(Bus bus, String name) {
        return new BusCommunication(bus.attach(name));
    }

    /** The address of the component on the bus. */
    public Address address() {
        return port.address();
    }

    void publish(ApplicationData<?> data) {
        publishTyped(data);
    }

    private <T extends Record> void publishTyped(ApplicationData<T> data) {
        port.publish(data.topic(), data.value());
    }

    void subscribe(List<BusTopic<?>> topics, Consumer<ApplicationData<?>> listener) {
        topics.forEach(topic -> subscribe(topic, listener));
    }

    private <T extends Record> void subscribe(BusTopic<T> topic, Consumer<ApplicationData<?>> listener) {
        subscriptions.add(
                port.subscribe(topic, (value, publisher) -> listener.accept(new ApplicationData<>(topic, value))));
    }

    void unsubscribeAll() {
        subscriptions.forEach(BusPort.Subscription::close);
        subscriptions.clear();
    }

    <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> answerer) {
        port.answer(operation, answerer);
    }

    @Override
    public void close() {
        port.close();
    }
}
