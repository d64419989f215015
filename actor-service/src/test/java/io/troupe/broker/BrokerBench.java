package io.troupe.broker;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

/** A broker on a space without a thread; records its events and the calls of its providers. */
final class BrokerBench implements AutoCloseable {
    static final Duration SECOND = Duration.ofSeconds(1);

    final TestSpace test = new TestSpace();
    final List<BrokerEvent> events = new ArrayList<>();
    final List<String> diary = new ArrayList<>();
    final Broker broker;

    BrokerBench() {
        this(BrokerSettings.DEFAULT);
    }

    BrokerBench(BrokerSettings settings) {
        broker = Broker.open(test.space(), settings.withObserver(events::add));
    }

    static Address at(String name) {
        return new Address("node", name);
    }

    FakeProvider offer(String service, String name, String... capabilities) {
        var provider = new FakeProvider(name, diary);
        test.get(broker.register(service, List.of(capabilities), at(name), provider));
        return provider;
    }

    FakeProvider provider(String name) {
        return new FakeProvider(name, diary);
    }

    ServiceRecord require(String service) {
        return test.get(broker.require(Need.ofService("robot 1", service)));
    }

    String missing(Promise<?> promise) {
        Throwable error = test.error(promise);
        if (!(error instanceof MissingServiceException)) {
            throw new AssertionError("expected a missing service", error);
        }
        return String.valueOf(error.getMessage());
    }

    /** Connects a client that records its notifications. */
    List<String> connect(String by, String service) {
        var heard = new ArrayList<String>();
        var first = broker.connect(Need.ofService(by, service), new Broker.Connection() {
            @Override
            public void use(ServiceRecord provider) {
                heard.add("use " + provider.provider().name());
                diary.add(by + " hears of " + provider.provider().name());
            }

            @Override
            public void lost(MissingServiceException why) {
                heard.add("lost");
                diary.add(by + " hears of the loss");
            }
        });
        first.handle((record, error) -> null);
        test.crank();
        return heard;
    }

    /** Runs pending work, then advances the clock. */
    void pass(Duration time) {
        test.crank();
        test.advance(time);
    }

    /** Advances the clock by this many seconds, one at a time. */
    void seconds(int count) {
        for (int i = 0; i < count; i++) {
            pass(SECOND);
        }
    }

    Health health(String name) {
        return test.get(broker.registered()).stream()
                .filter(each -> each.provider().equals(at(name)))
                .findFirst()
                .orElseThrow()
                .health();
    }

    <E extends BrokerEvent> List<E> events(Class<E> type) {
        return events.stream().filter(type::isInstance).map(type::cast).toList();
    }

    @Override
    public void close() {
        test.get(broker.shutDown());
        test.close();
    }
}
