package io.troupe.services.component;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.BrokerSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;

/** Base of tests of components: a bus on a manually driven space, a user of the bus, and an observer. */
public abstract class ComponentBench {
    protected final TestSpace test = new TestSpace();
    protected final Bus bus = Bus.inProcess("here", BusSettings.on(test.space()));
    protected final BusPort user = bus.attach("user");
    protected final RecordingObserver notes = new RecordingObserver();
    private final ComponentBroker broker = new ComponentBroker(test.space(), BrokerSettings.defaults(), notes);

    @AfterEach
    protected void nothingIsLeftOnTheBus() {
        bus.close();
        test.runQueued();
        test.close();
    }

    protected <I, O> ComponentBroker.Registered<I, O> open(
            String name, Component<I, O> component, ComponentObserver observer) {
        var opened = new ArrayList<ComponentBroker.Registered<I, O>>();
        test.run(() -> opened.add(broker.register(ComponentInterface.open(bus, name, component, observer))));
        return opened.getFirst();
    }

    /** Opens and starts a component, and discards the notes about it. */
    protected <I, O> ComponentBroker.Registered<I, O> start(String name, Component<I, O> component) {
        var provider = open(name, component, notes);
        test.get(provider.start());
        notes.take();
        return provider;
    }

    protected <T extends Record> void publish(BusTopic<T> topic, T value) {
        test.run(() -> user.publish(topic, value));
    }

    /** Subscribes to a topic and collects its values. */
    protected <T extends Record> List<T> listenTo(BusTopic<T> topic) {
        var heard = new ArrayList<T>();
        test.run(() -> user.subscribe(topic, (value, from) -> heard.add(value)));
        return heard;
    }
}
