package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Health;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.Address;
import io.troupe.bus.Operation;
import java.time.Duration;
import java.util.List;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/** A broker that starts and stops the components of a test, and notes its events as {@code counter Started}. */
public final class ComponentBroker {
    /** The limits are those of a slow machine for processes, and those of the broker on a manual clock. */
    public static final BrokerSettings PATIENT = BrokerSettings.defaults()
            .withStartLimit(Duration.ofMinutes(1))
            .withStopLimit(Duration.ofMinutes(1))
            .withNotifyLimit(Duration.ofMinutes(1))
            .withoutRestart();

    private final Broker broker;
    private final RecordingObserver notes;
    private volatile Deferred<@Nullable Void> failure = Deferred.unbound();

    public ComponentBroker(ActorSpace space, BrokerSettings settings, RecordingObserver notes) {
        this.notes = notes;
        this.broker = Broker.open(space, settings.withObserver(this::note));
    }

    private void note(BrokerEvent event) {
        switch (event) {
            case BrokerEvent.Starting(var provider) -> notes.info(provider.provider(), "Starting");
            case BrokerEvent.Started(var provider) -> notes.info(provider.provider(), "Started");
            case BrokerEvent.Stopped(var provider) -> notes.info(provider.provider(), "Stopped");
            case BrokerEvent.Failed(var provider, var why) -> {
                notes.info(provider.provider(), "Failed");
                failure.resolve(null);
            }
            case BrokerEvent.StartFailed(var provider, var why) -> notes.info(provider.provider(), "StartFailed");
            case BrokerEvent.StopFailed(var provider, var why) ->
                notes.info(provider.provider(), "StopFailed: " + why.getMessage());
            default -> {}
        }
    }

    /** Fulfilled when a component fails from now on, in the turn in which the broker learns of it. */
    public Promise<@Nullable Void> nextFailure() {
        failure = Deferred.unbound();
        return failure;
    }

    public <I, O> Registered<I, O> register(ComponentInterface<I, O> component) {
        var registered = new Registered<>(component);
        registered.register();
        return registered;
    }

    /** A component under test. Its service is its address. */
    public final class Registered<I, O> {
        private final ComponentInterface<I, O> component;

        private Registered(ComponentInterface<I, O> component) {
            this.component = component;
        }

        private void register() {
            broker.register(address().toString(), List.of(), address(), component::newLife)
                    .handle((done, error) -> null);
        }

        /** Rejected with the component's own error. */
        public Promise<@Nullable Void> start() {
            return broker.require(Need.ofService("test", address().toString()))
                    .<@Nullable Void>thenApply(started -> null)
                    .exceptionallyCompose(error -> Promise.failed(
                            error instanceof MissingServiceException && error.getSuppressed().length > 0
                                    ? error.getSuppressed()[0]
                                    : error));
        }

        /** It can be started again. */
        public Promise<@Nullable Void> stop() {
            var stopped = broker.withdraw(address());
            stopped.handle((done, error) -> null); // the test may look at it later, or not at all
            register();
            return stopped;
        }

        public Promise<@Nullable Void> check() {
            return component.check();
        }

        /** Call on the space. */
        public void close() {
            component.close();
            broker.withdraw(address()).handle((done, error) -> null);
        }

        public Promise<Health> health() {
            return broker.registered()
                    .thenApply(all -> all.stream()
                            .filter(each -> each.provider().equals(address()))
                            .map(ServiceRecord::health)
                            .findFirst()
                            .orElseThrow());
        }

        public Address address() {
            return component.address();
        }

        public DataConversion<I, O> conversion() {
            return component.conversion();
        }

        public <Q extends Record, A extends Record> void answer(
                Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> handler) {
            component.answer(operation, handler);
        }
    }
}
