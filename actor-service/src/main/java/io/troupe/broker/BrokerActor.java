package io.troupe.broker;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.Predicate;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The actor of a {@link Broker}: keeps the registry, and assigns a provider to each need. Not final: its proxy is a
 * subclass.
 */
class BrokerActor extends Actor {
    private final ProviderRegistry registry = new ProviderRegistry();
    private final EventPublisher events;
    private final Supervisor supervisor;
    private final Restarts restarts;
    private final ConnectedClients clients;
    private @Nullable Promise<List<ServiceRecord>> shutDown;

    BrokerActor(ActorSpace space, BrokerSettings settings) {
        var timeouts = new Timeouts(this::after);
        this.events = new EventPublisher(settings.observer(), space);
        this.supervisor =
                new Supervisor(settings, timeouts, events, registry::predecessors, this::hasStarted, this::hasFailed);
        this.clients = new ConnectedClients(this::choose, timeouts, settings, events);
        this.restarts = new Restarts(
                settings,
                timeouts,
                supervisor,
                registration -> registry.has(registration) && clients.waitFor(registration));
    }

    public Promise<ServiceRecord> register(Registration registration) {
        checkOpen();
        registry.add(registration);
        events.publish(new BrokerEvent.Registered(registration.toRecord()));
        clients.retry(registration::meets);
        return Promise.of(registration.toRecord());
    }

    public Promise<@Nullable Void> withdraw(Address provider) {
        checkOpen();
        Registration registration = registry.known(provider);
        registry.remove(registration);
        events.publish(new BrokerEvent.Withdrawn(registration.toRecord()));
        return leave(registration, () -> clients.leave(registration));
    }

    /**
     * Stops a provider that was withdrawn or replaced.
     *
     * @param notifyClients notifies its clients; the provider is stopped after that, or earlier if a successor has to
     *     be started
     */
    private Promise<@Nullable Void> leave(Registration registration, Supplier<Promise<?>> notifyClients) {
        var leaving = new Deferred<@Nullable Void>();
        Promise<@Nullable Void> stopped = leaving.thenCompose(notified -> supervisor.stop(registration));
        registration.leaving = leaving;
        registration.gone = stopped.handle((nothing, error) -> {
            registry.forget(registration);
            return null;
        }); // set before its clients look for another provider, which may be a successor
        registration.cancelTimers();
        supervisor.rejectWaitingStart(registration);
        notifyClients.get().handle((notified, error) -> leaving.resolve(null));
        return stopped;
    }

    public Promise<ServiceRecord> replace(Address old, Registration by) {
        checkOpen();
        Registration before = registry.known(old);
        if (before.isBeingReplaced) {
            throw new IllegalStateException(old + " is being replaced already, expected one replacement at a time");
        }
        registry.checkFree(by.address, old);
        registry.reserve(by);
        before.isBeingReplaced = true;
        var done = new Deferred<ServiceRecord>();
        supervisor.start(by).handle((started, error) -> {
            before.isBeingReplaced = false;
            registry.free(by.address);
            if (error != null) {
                done.reject(new ProviderException(
                        by + " could not be started in the place of " + old + ", which stays in use: "
                                + Reasons.of(error),
                        error));
            } else {
                // a failed stop of the old provider is reported to the observer
                takeOver(before, by).handle((stopped, stays) -> done.resolve(by.toRecord()));
            }
            return null;
        });
        return done;
    }

    private Promise<@Nullable Void> takeOver(Registration before, Registration by) {
        Promise<@Nullable Void> withdrawn = before.gone;
        registry.put(by, before);
        events.publish(new BrokerEvent.Replaced(before.toRecord(), by.toRecord()));
        Promise<@Nullable Void> stopped = withdrawn != null ? withdrawn : leave(before, () -> clients.move(before, by));
        clients.retry(by::meets);
        return stopped;
    }

    public Promise<List<ServiceRecord>> registered() {
        return Promise.of(registry.records());
    }

    public Promise<List<ServiceRecord>> find(Need need) {
        return Promise.of(
                registry.meeting(need).stream().map(Registration::toRecord).toList());
    }

    public Promise<ServiceRecord> require(Need need) {
        checkOpen();
        var found = new Deferred<ServiceRecord>();
        choose(need, true, registration -> found.resolve(registration.toRecord()), found::reject);
        return found;
    }

    /** @param callback runs the listener on the client's space; cancelled when the client's actor has stopped */
    public Promise<ServiceRecord> connect(
            Need need, Broker.Connection connection, Callback<ConnectedClients.Notification> callback) {
        checkOpen();
        return clients.connect(need, connection, callback);
    }

    public Promise<@Nullable Void> disconnect(Broker.Connection connection) {
        clients.disconnect(connection);
        return Promise.done();
    }

    // ---- choosing a provider

    private void choose(
            Need need, boolean evenFailed, Consumer<Registration> found, Consumer<MissingServiceException> none) {
        tryNext(need, evenFailed, new LinkedHashMap<>(), found, none);
    }

    private void tryNext(
            Need need,
            boolean evenFailed,
            Map<Registration, Throwable> tried,
            Consumer<Registration> found,
            Consumer<MissingServiceException> none) {
        var best =
                registry.best(need, each -> !tried.containsKey(each) && (evenFailed || each.health != Health.FAILED));
        if (supervisor.isClosing()) {
            none.accept(ProviderRegistry.closing(need));
            return;
        }
        if (best.isEmpty()) {
            none.accept(registry.missing(need, tried));
            restarts.consider(registry.meeting(need));
            return;
        }
        Registration registration = best.get();
        if (registration.isRunning()) {
            found.accept(registration);
            return;
        }
        supervisor.start(registration).handle((started, error) -> {
            if (error != null) {
                tried.put(registration, error);
            } else if (!registration.isRunning()) {
                tried.put(
                        registration,
                        new ProviderException(registration + " ended while it started", registration.why));
            } // it is now one of the best, unless it was withdrawn meanwhile
            tryNext(need, evenFailed, tried, found, none);
            return null;
        });
    }

    private void hasStarted(Registration registration) {
        if (registry.has(registration)) {
            clients.retry(registration::meets);
        }
    }

    private void hasFailed(Registration registration) {
        clients.leave(registration);
    }

    // ---- shutdown

    public Promise<List<ServiceRecord>> shutDown() {
        if (shutDown == null) {
            var done = new Deferred<List<ServiceRecord>>();
            shutDown = done;
            supervisor.beginClosing();
            clients.endAll().handle((notified, error) -> {
                stopLast(supervisor.begun(), done);
                return null;
            });
        }
        return shutDown;
    }

    /** Stops the providers of the list one by one, the last first. */
    private void stopLast(List<Registration> rest, Deferred<List<ServiceRecord>> done) {
        if (rest.isEmpty()) {
            done.resolve(supervisor.begun().stream().map(Registration::toRecord).toList());
        } else {
            supervisor.stop(rest.getLast()).handle((stopped, error) -> {
                stopLast(rest.subList(0, rest.size() - 1), done);
                return null;
            });
        }
    }

    private void checkOpen() {
        if (supervisor.isClosing()) {
            throw new IllegalStateException("the broker is closed");
        }
    }

    @Override
    protected void stopped() {
        supervisor.begun().forEach(registration -> events.publish(new BrokerEvent.Abandoned(registration.toRecord())));
    }

    /** Restarts failed providers that a connection waits for, after increasing pauses. Runs on the broker's space. */
    private static final class Restarts {
        private final BrokerSettings settings;
        private final Timeouts timeouts;
        private final Supervisor supervisor;
        private final Predicate<Registration> wanted;

        Restarts(BrokerSettings settings, Timeouts timeouts, Supervisor supervisor, Predicate<Registration> wanted) {
            this.settings = settings;
            this.timeouts = timeouts;
            this.supervisor = supervisor;
            this.wanted = wanted;
        }

        void consider(List<Registration> some) {
            some.forEach(this::consider);
        }

        private void consider(Registration registration) {
            if (settings.restartPause().isZero()
                    || registration.health != Health.FAILED
                    || registration.nextRestart != null
                    || supervisor.isClosing()
                    || !wanted.test(registration)) {
                return;
            }
            Duration pause = next(registration.restartPause);
            registration.restartPause = pause;
            registration.nextRestart = timeouts.after(pause, () -> {
                registration.nextRestart = null;
                if (registration.health == Health.FAILED && !supervisor.isClosing() && wanted.test(registration)) {
                    supervisor.start(registration).handle((started, error) -> {
                        consider(registration);
                        return null;
                    });
                }
            });
        }

        private Duration next(@Nullable Duration before) {
            if (before == null) {
                return settings.restartPause();
            }
            Duration twice = before.multipliedBy(2);
            return twice.compareTo(settings.longestRestartPause()) < 0 ? twice : settings.longestRestartPause();
        }
    }
}
