package io.troupe.broker;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * The actor of a {@link Broker}: keeps the registry, and assigns a provider to each need. Not final: its proxy is a
 * subclass.
 */
class BrokerActor extends Actor {
    private final ProviderRegistry registry = new ProviderRegistry();
    private final EventPublisher events;
    private final BrokerContext context;
    private final ConnectedClients clients;
    private @Nullable Promise<List<ServiceRecord>> shutDown;
    private Runnable changed = () -> {};
    private final Map<Address, Offer> elsewhere = new HashMap<>(); // all that other processes offer
    private final Map<Address, Place> places = new HashMap<>(); // after replacements by offered providers

    BrokerActor(ActorSpace space, BrokerSettings settings) {
        var timeouts = new Timeouts((delay, task) -> context().after(delay, task));
        this.events = new EventPublisher(settings.observer(), space);
        this.context = new BrokerContext(settings, timeouts, events, new ToClients());
        this.clients = new ConnectedClients(this::choose, timeouts, settings, events);
    }

    public Promise<ServiceRecord> register(
            String service, List<String> capabilities, Address address, ManagedProvider.Source provider) {
        checkOpen();
        var registration = new ManagedProvider(service, capabilities, address, provider, context);
        registry.add(registration);
        events.publish(new BrokerEvent.Registered(registration.toRecord()));
        clients.retry(registration::meets);
        return Promise.of(registration.toRecord());
    }

    public Promise<@Nullable Void> withdraw(Address provider) {
        checkOpen();
        ManagedProvider registration = registry.known(provider);
        registry.remove(registration);
        events.publish(new BrokerEvent.Withdrawn(registration.toRecord()));
        return registration.leave(() -> clients.leave(registration));
    }

    public Promise<ServiceRecord> replace(
            Address old, String service, List<String> capabilities, Address address, ManagedProvider.Source provider) {
        checkOpen();
        ManagedProvider before = registry.known(old);
        before.checkNotBeingReplaced();
        registry.checkFree(address, old);
        var by = new ManagedProvider(service, capabilities, address, provider, context);
        registry.reserve(by);
        before.setBeingReplaced(true);
        var done = new Deferred<ServiceRecord>();
        by.start().onSettled((started, error) -> {
            before.setBeingReplaced(false);
            registry.free(by.address);
            if (error != null) {
                done.reject(new ProviderException(
                        by + " could not be started in the place of " + old + ", which stays in use: "
                                + Reasons.of(error),
                        error));
            } else {
                // a failed stop of the old provider is reported to the observer
                takeOver(before, by).onSettled((stopped, stays) -> done.resolve(by.toRecord()));
            }
        });
        return done;
    }

    /** The same with a provider that another process offers. */
    public Promise<ServiceRecord> replaceByOffered(
            Address old, String service, List<String> capabilities, Address address) {
        checkOpen();
        registry.known(old).checkNotBeingReplaced();
        Offer offer = elsewhere.get(address);
        if (offer == null) {
            throw new IllegalArgumentException(
                    "no other process offers " + address + "; offered: " + elsewhere.keySet());
        }
        ManagedProvider idle =
                registry.at(address).filter(each -> !each.address.equals(old)).orElse(null);
        if (idle != null) {
            if (idle.isInUse()) {
                throw new IllegalArgumentException(address + " is in use, expected a provider that is not");
            }
            idle.checkNotBeingReplaced();
            registry.drop(idle);
        }
        Place oldPlace = places.put(old, Place.NONE);
        Place newPlace = places.put(address, new Place(service, capabilities));
        return replace(old, service, capabilities, address, ManagedProvider.Source.of(offer.provider))
                .whenComplete((record, error) -> {
                    if (error == null
                            && !context.isClosing()
                            && elsewhere.get(address) != offer) { // withdrawn meanwhile, or offered anew
                        registry.of(offer.provider)
                                .ifPresent(stale ->
                                        withdraw(stale.address).onRejected(failed -> {})); // a failure is an event
                        registerOffered(address);
                    }
                })
                .exceptionallyCompose(error -> {
                    putBack(old, oldPlace);
                    putBack(address, newPlace);
                    if (idle != null && !context.isClosing() && elsewhere.get(address) == offer) {
                        registry.add(idle);
                    } else {
                        registerOffered(address); // the process has restarted meanwhile
                    }
                    return Promise.failed(error);
                });
    }

    private void putBack(Address address, @Nullable Place place) {
        if (place == null) {
            places.remove(address);
        } else {
            places.put(address, place);
        }
    }

    /** What another process offers. */
    private record Offer(String service, List<String> capabilities, OfferedProvider provider) {}

    /** The service that a provider of another process has here since a replacement, also after its restarts. */
    private record Place(String service, List<String> capabilities) {
        static final Place NONE = new Place("", List.of()); // it was replaced
    }

    private Promise<@Nullable Void> takeOver(ManagedProvider before, ManagedProvider by) {
        Promise<@Nullable Void> withdrawn = before.whenGone();
        registry.put(by, before);
        events.publish(new BrokerEvent.Replaced(before.toRecord(), by.toRecord()));
        Promise<@Nullable Void> stopped = withdrawn != null ? withdrawn : before.leave(() -> clients.move(before, by));
        clients.retry(by::meets);
        return stopped;
    }

    public Promise<List<ServiceRecord>> registered() {
        return Promise.of(registry.records());
    }

    public Promise<List<ServiceRecord>> find(Need need) {
        return Promise.of(
                registry.meeting(need).stream().map(ManagedProvider::toRecord).toList());
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

    // ---- for the brokers of other processes

    /** A provider of this process, and the number of its last life. */
    record Offering(ServiceRecord record, long life) {}

    /** The providers of this process; none if the broker is being closed. */
    record Offerings(List<Offering> all, boolean closing) {}

    /**
     * The providers of this process are offered to others.
     *
     * @param onChange is called when they may have changed
     */
    public void share(String node, Sharing sharing, Runnable onChange) {
        registry.share(node, sharing);
        changed = onChange;
        events.setOnEvent(onChange);
    }

    public Promise<Offerings> offerings() {
        return Promise.of(new Offerings(
                context.isClosing()
                        ? List.of()
                        : registry.local().stream()
                                .map(each -> new Offering(each.toRecord(), each.life()))
                                .toList(),
                context.isClosing()));
    }

    /** Starts a provider of this process unless it runs. */
    public Promise<Offering> startAt(Address provider) {
        checkOpen();
        ManagedProvider registration = registry.known(provider);
        if (registration.offered() != null) {
            throw new IllegalArgumentException(provider + " is not a provider of this process");
        }
        return registration.start().thenApply(started -> new Offering(registration.toRecord(), registration.life()));
    }

    /** Stops a provider of this process, unless a later life runs. */
    public Promise<@Nullable Void> stopAt(Address provider, long life) {
        ManagedProvider registration = registry.known(provider);
        return life == 0 || life == registration.life() ? registration.stop() : Promise.done();
    }

    /** Stops a provider of this process if it runs, because it is not used any more. */
    public void stopUnused(Address provider, String why) {
        registry.at(provider).filter(ManagedProvider::isInUse).ifPresent(unused -> {
            events.publish(new BrokerEvent.Unused(unused.toRecord(), why));
            unused.stop().onRejected(error -> {}); // a failure is an event
        });
    }

    /** The health of a life of a provider of this process; rejected if that life has ended. */
    public Promise<Health> healthOf(Address provider, long life) {
        ManagedProvider registration = registry.known(provider);
        if (!registration.isRunning() || registration.life() != life) {
            throw new ProviderException("life " + life + " of " + provider + " has ended", registration.why());
        }
        return Promise.of(registration.health());
    }

    /**
     * A provider of another process may be used even if it has failed before.
     *
     * @param runs whether it runs; if not, it is started only if a client waits for it
     */
    public void revive(Address provider, boolean runs) {
        registry.at(provider)
                .filter(each -> runs ? each.hasFailed() && !context.isClosing() : each.isRestartWanted())
                .ifPresent(each -> each.start().onRejected(error -> {})); // a failure is an event
    }

    /** Another process offers a provider. One that this process has registered itself at that address counts more. */
    public void offer(String service, List<String> capabilities, OfferedProvider provider) {
        elsewhere.put(provider.address(), new Offer(service, capabilities, provider));
        registerOffered(provider.address());
    }

    private void registerOffered(Address address) {
        Offer offer = elsewhere.get(address);
        if (offer == null || context.isClosing() || !registry.isFree(address)) {
            return;
        }
        Place place = places.getOrDefault(address, new Place(offer.service, offer.capabilities));
        if (place != Place.NONE) {
            register(place.service, place.capabilities, address, ManagedProvider.Source.of(offer.provider));
        }
    }

    /** Another process does not offer a provider any more. */
    public void withdrawOffered(OfferedProvider provider) {
        elsewhere.computeIfPresent(provider.address(), (address, offer) -> offer.provider == provider ? null : offer);
        registry.of(provider)
                .filter(each -> !context.isClosing())
                .ifPresent(each -> withdraw(each.address).onRejected(error -> {}));
    }

    // ---- choosing a provider

    private void choose(
            Need need, boolean evenFailed, Consumer<ManagedProvider> found, Consumer<MissingServiceException> none) {
        tryNext(need, evenFailed, new LinkedHashMap<>(), found, none);
    }

    private void tryNext(
            Need need,
            boolean evenFailed,
            Map<ManagedProvider, Throwable> tried,
            Consumer<ManagedProvider> found,
            Consumer<MissingServiceException> none) {
        var best = registry.best(need, each -> !tried.containsKey(each) && (evenFailed || each.mayBeTried()));
        if (context.isClosing()) {
            none.accept(ProviderRegistry.closing(need));
            return;
        }
        if (best.isEmpty()) {
            none.accept(registry.missing(need, tried));
            registry.meeting(need).forEach(ManagedProvider::considerRestart);
            return;
        }
        ManagedProvider registration = best.get();
        if (registration.isRunning()) {
            found.accept(registration);
            return;
        }
        registration.start().onSettled((started, error) -> {
            if (error != null) {
                tried.put(registration, error);
            } else if (!registration.isRunning()) {
                tried.put(
                        registration,
                        new ProviderException(registration + " ended while it started", registration.why()));
            } // it is now one of the best, unless it was withdrawn meanwhile
            tryNext(need, evenFailed, tried, found, none);
        });
    }

    /** Passes starts and failures of providers on to the clients. */
    private final class ToClients implements BrokerContext.Listener {
        @Override
        public List<ManagedProvider> predecessors(ManagedProvider registration) {
            return registry.predecessors(registration);
        }

        @Override
        public void onStarted(ManagedProvider registration) {
            if (registry.has(registration)) {
                clients.retry(registration::meets);
            }
        }

        @Override
        public void onFailed(ManagedProvider registration) {
            clients.leave(registration);
        }

        @Override
        public void onGone(ManagedProvider registration) {
            registry.forget(registration);
        }

        @Override
        public boolean isWanted(ManagedProvider registration) {
            return registry.has(registration) && clients.waitFor(registration);
        }
    }

    // ---- shutdown

    public Promise<List<ServiceRecord>> shutDown() {
        if (shutDown == null) {
            var done = new Deferred<List<ServiceRecord>>();
            shutDown = done;
            context.beginClosing();
            changed.run();
            clients.endAll().onSettled((notified, error) -> {
                stopLast(context.begun(), done);
            });
        }
        return shutDown;
    }

    /** Stops the providers of the list one by one, the last first. */
    private void stopLast(List<ManagedProvider> rest, Deferred<List<ServiceRecord>> done) {
        if (rest.isEmpty()) {
            done.resolve(context.begun().stream().map(ManagedProvider::toRecord).toList());
        } else {
            rest.getLast().stop().onSettled((stopped, error) -> {
                stopLast(rest.subList(0, rest.size() - 1), done);
            });
        }
    }

    private void checkOpen() {
        if (context.isClosing()) {
            throw new IllegalStateException("the broker is closed");
        }
    }

    @Override
    protected void stopped() {
        context.begun().forEach(registration -> events.publish(new BrokerEvent.LeftRunning(registration.toRecord())));
    }
}
