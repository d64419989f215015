package io.troupe.broker;

import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;

/** A broker on a space without a thread; records its events. Tests extend it. */
class BrokerBench {
    static final BrokerSettings WITHOUT_RESTART = BrokerSettings.defaults().withoutRestart();

    final TestSpace test = new TestSpace();
    final List<BrokerEvent> events = new ArrayList<>();
    final List<String> diary = new ArrayList<>();
    Broker broker;

    BrokerBench(BrokerSettings settings) {
        broker = Broker.open("node", test.space(), settings.withObserver(this::record));
    }

    /** Goes on with a broker of other settings. */
    final void reopen(BrokerSettings settings) {
        get(broker.closeAsync());
        broker = Broker.open("node", test.space(), settings.withObserver(this::record));
    }

    void record(BrokerEvent event) {
        events.add(event);
    }

    @AfterEach
    void close() {
        get(broker.closeAsync());
        test.close();
    }

    final <T extends @Nullable Object> T get(Promise<T> promise) {
        return test.get(promise);
    }

    static Address at(String name) {
        return new Address("node", name);
    }

    final String missing(Promise<?> promise) {
        Throwable error = test.error(promise);
        if (!(error instanceof MissingServiceException)) {
            throw new AssertionError("expected a missing service", error);
        }
        return String.valueOf(error.getMessage());
    }

    /** Connects a client that records its notifications. */
    final void connect(Need need, Consumer<String> notified) {
        var client = new Broker.Connection() {
            @Override
            public void use(ServiceRecord provider) {
                notified.accept("use " + provider.provider().name());
            }

            @Override
            public void lost(MissingServiceException why) {
                notified.accept("lost");
            }
        };
        broker.connect(need, client).handle((record, error) -> null);
    }

    /** Runs pending work, then advances the clock. */
    final void pass(Duration time) {
        test.runQueued();
        test.advance(time);
    }

    /** Advances the clock by this many seconds, one at a time. */
    final void seconds(int count) {
        for (int i = 0; i < count; i++) {
            pass(Duration.ofSeconds(1));
        }
    }

    final Health health(String name) {
        return get(broker.registered()).stream()
                .filter(each -> each.provider().equals(at(name)))
                .findFirst()
                .orElseThrow()
                .health();
    }

    final <E extends BrokerEvent> List<E> events(Class<E> type) {
        return events.stream().filter(type::isInstance).map(type::cast).toList();
    }
}
