package io.troupe.services.broker;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Address;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** The broker's actor: keeps the registry, and assigns a provider to each need. */
final class BrokerActor extends Actor implements Registry {
    private final Roster roster = new Roster();
    private final Events events;
    private final Lifecycle lifecycle;
    private final Restarts restarts;
    private final Users users;
    private @Nullable Promise<List<ServiceRecord>> shutDown;

    BrokerActor(ActorSpace space, BrokerSettings settings) {
        var limits = new Limits(this::after);
        this.events = new Events(settings.observer(), space);
        this.lifecycle =
                new Lifecycle(settings, limits, events, roster::predecessors, this::hasStarted, this::hasFailed);
        this.users = new Users(this::choose, limits, settings, events);
        this.restarts = new Restarts(settings, limits, lifecycle, it -> roster.has(it) && users.waitFor(it));
    }

    @Override
    public Promise<ServiceRecord> register(Registration it) {
        checkOpen();
        roster.add(it);
        events.tell(new BrokerEvent.Registered(it.toRecord()));
        users.retry(it::meets);
        return Promise.of(it.toRecord());
    }

    @Override
    public Promise<@Nullable Void> withdraw(Address provider) {
        checkOpen();
        Registration it = roster.known(provider);
        roster.remove(it);
        events.tell(new BrokerEvent.Withdrawn(it.toRecord()));
        return leave(it, () -> users.leave(it));
    }

    /**
     * Stops a provider that was withdrawn or replaced.
     *
     * @param tellUsers notifies its clients; the provider is stopped after that, or earlier if a successor has to be
     *     started
     */
    private Promise<@Nullable Void> leave(Registration it, Supplier<Promise<?>> tellUsers) {
        var leaving = new Deferred<@Nullable Void>();
        Promise<@Nullable Void> stopped = leaving.thenCompose(notified -> lifecycle.stop(it));
        it.leaving = leaving;
        it.gone = stopped.handle((nothing, error) -> {
            roster.forget(it);
            return null;
        }); // set before its clients look for another provider, which may be a successor
        it.cancelTimers();
        lifecycle.rejectWaitingStart(it);
        tellUsers.get().handle((notified, error) -> leaving.resolve(null));
        return stopped;
    }

    @Override
    public Promise<ServiceRecord> replace(Address old, Registration by) {
        checkOpen();
        Registration before = roster.known(old);
        if (before.isBeingReplaced) {
            throw new IllegalStateException(old + " is being replaced already, expected one replacement at a time");
        }
        roster.checkFree(by.address, old);
        roster.reserve(by);
        before.isBeingReplaced = true;
        var done = new Deferred<ServiceRecord>();
        lifecycle.start(by).handle((started, error) -> {
            before.isBeingReplaced = false;
            roster.free(by.address);
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
        roster.put(by, before);
        events.tell(new BrokerEvent.Replaced(before.toRecord(), by.toRecord()));
        Promise<@Nullable Void> stopped = withdrawn != null ? withdrawn : leave(before, () -> users.move(before, by));
        users.retry(by::meets);
        return stopped;
    }

    @Override
    public Promise<List<ServiceRecord>> registered() {
        return Promise.of(roster.records());
    }

    @Override
    public Promise<List<ServiceRecord>> find(Need need) {
        return Promise.of(
                roster.meeting(need).stream().map(Registration::toRecord).toList());
    }

    @Override
    public Promise<ServiceRecord> require(Need need) {
        checkOpen();
        var found = new Deferred<ServiceRecord>();
        choose(need, true, it -> found.resolve(it.toRecord()), found::reject);
        return found;
    }

    @Override
    public Promise<ServiceRecord> connect(Need need, Broker.Connection connection, Callback<Users.Told> line) {
        checkOpen();
        return users.connect(need, connection, line);
    }

    @Override
    public Promise<@Nullable Void> disconnect(Broker.Connection connection) {
        users.disconnect(connection);
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
        var best = roster.best(need, each -> !tried.containsKey(each) && (evenFailed || each.health != Health.FAILED));
        if (lifecycle.isClosing()) {
            none.accept(Roster.closing(need));
            return;
        }
        if (best.isEmpty()) {
            none.accept(roster.missing(need, tried));
            restarts.consider(roster.meeting(need));
            return;
        }
        Registration it = best.get();
        if (it.isRunning()) {
            found.accept(it);
            return;
        }
        lifecycle.start(it).handle((started, error) -> {
            if (error != null) {
                tried.put(it, error);
            } else if (!it.isRunning()) {
                tried.put(it, new ProviderException(it + " ended while it started", it.why));
            } // it is now one of the best, unless it was withdrawn meanwhile
            tryNext(need, evenFailed, tried, found, none);
            return null;
        });
    }

    private void hasStarted(Registration it) {
        if (roster.has(it)) {
            users.retry(it::meets);
        }
    }

    private void hasFailed(Registration it) {
        users.leave(it);
    }

    // ---- shutdown

    @Override
    public Promise<List<ServiceRecord>> shutDown() {
        if (shutDown == null) {
            var done = new Deferred<List<ServiceRecord>>();
            shutDown = done;
            lifecycle.beginClosing();
            users.endAll().handle((heard, error) -> {
                stopLast(lifecycle.begun(), done);
                return null;
            });
        }
        return shutDown;
    }

    /** Stops the providers of the list one by one, the last first. */
    private void stopLast(List<Registration> rest, Deferred<List<ServiceRecord>> done) {
        if (rest.isEmpty()) {
            done.resolve(lifecycle.begun().stream().map(Registration::toRecord).toList());
        } else {
            lifecycle.stop(rest.getLast()).handle((stopped, error) -> {
                stopLast(rest.subList(0, rest.size() - 1), done);
                return null;
            });
        }
    }

    private void checkOpen() {
        if (lifecycle.isClosing()) {
            throw new IllegalStateException("the broker is closed");
        }
    }

    @Override
    protected void stopped() {
        lifecycle.begun().forEach(it -> events.tell(new BrokerEvent.Abandoned(it.toRecord())));
    }
}
