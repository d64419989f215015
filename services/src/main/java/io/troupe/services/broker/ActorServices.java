package io.troupe.services.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Address;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentMap;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The actor as a service: actors of this process are published at a broker, and called through it by their own
 * interfaces.
 *
 * <p><b>Role.</b> One for a broker and a process. Who is published here can be called through {@link #connect} of the
 * same object; an actor can be both publisher and subscriber.
 *
 * <p><b>Threads.</b> Any thread.
 *
 * <p><b>Errors.</b> An actor's health is asked for by an entry in its space's queue, which comes back when everything
 * sent there before is done: a space that hangs, or is far behind, is noticed, but only by a broker on another space,
 * since a broker on the same one hangs with it. An actor that stops, by whatever cause, is noticed at once on every
 * space. An actor whose message throws goes on, and is well, unless its {@link ActorSettings} say that it stops then.
 *
 * <p><b>Source.</b> Paper, section 1: actors that expose services, each a publisher and a subscriber.
 */
public final class ActorServices {
    private final Broker broker;
    private final String node;
    private final ActorSpace home;
    private final BrokerObserver observer;
    private final ConcurrentMap<Address, ActorProvider.Running> directory = new ConcurrentHashMap<>();
    private final ConcurrentMap<String, Integer> published = new ConcurrentHashMap<>();

    /**
     * Actors as services.
     *
     * @param node the name of this process, for addresses
     * @param home where connections live that are made outside every actor space
     * @param observer hears of calls that reached nobody, and of answers that came too late
     */
    public ActorServices(Broker broker, String node, ActorSpace home, BrokerObserver observer) {
        this.broker = Objects.requireNonNull(broker, "broker");
        this.node = Objects.requireNonNull(node, "node");
        this.home = Objects.requireNonNull(home, "home");
        this.observer = Objects.requireNonNull(observer, "observer");
    }

    /**
     * Publishes an actor that the broker spawns when it is needed. Its address is the service's name, with a number if
     * it is not the first of this service.
     *
     * @param space where it will live
     * @param type an actor type; others connect to it by this interface, or one that it extends
     * @param factory makes it, on its space, at each start
     */
    public <A> Promise<ServiceRecord> publish(
            ActorSpace space, Class<A> type, String service, List<String> capabilities, Supplier<? extends A> factory) {
        Address address = nextAddress(service);
        return broker.register(service, capabilities, address, provider(address, space, type, factory, named(address)));
    }

    /**
     * Publishes an actor that is there already. The broker watches it, but neither starts nor stops it: that is for
     * whoever spawned it.
     */
    public <A> Promise<ServiceRecord> publishSpawned(
            ActorSpace space, String service, List<String> capabilities, A proxy) {
        Address address = nextAddress(service);
        return broker.register(service, capabilities, address, new SpawnedProvider(address, space, proxy, directory));
    }

    /** Publishes an actor in another's place, while others call it; see {@link Broker#replace}. */
    public <A> Promise<ServiceRecord> replace(
            Address old,
            ActorSpace space,
            Class<A> type,
            String service,
            List<String> capabilities,
            Supplier<? extends A> factory) {
        Address address = nextAddress(service);
        return broker.replace(
                old, service, capabilities, address, provider(address, space, type, factory, named(address)));
    }

    /** What a broker needs to run an actor, for an address and settings of one's own choice. */
    public <A> Provider provider(
            Address address, ActorSpace space, Class<A> type, Supplier<? extends A> factory, ActorSettings settings) {
        return new ActorProvider<>(address, space, type, factory, settings, directory);
    }

    /** A connection with the usual limits; see {@link #connect(Class, Need, ConnectionSettings)}. */
    public <A> ActorConnection<A> connect(Class<A> type, Need need) {
        return connect(type, need, ConnectionSettings.DEFAULT);
    }

    /**
     * Connects to whoever provides a service now, and to whoever takes its place later.
     *
     * @param type the interface by which it is called; its providers have to be published by it, or by one that extends
     *     it
     * @throws IllegalArgumentException if it is not an interface whose methods return {@code void} or {@link Promise}
     */
    public <A> ActorConnection<A> connect(Class<A> type, Need need, ConnectionSettings settings) {
        Relay.check(type);
        ActorSpace current = ActorSpace.current();
        return ActorConnection.open(current == null ? home : current, this, type, need, settings);
    }

    Broker broker() {
        return broker;
    }

    BrokerObserver observer() {
        return observer;
    }

    ActorProvider.@Nullable Running running(Address address) {
        return directory.get(address);
    }

    private Address nextAddress(String service) {
        int number = published.merge(service, 1, Integer::sum);
        return new Address(node, number == 1 ? service : service + "-" + number);
    }

    private static ActorSettings named(Address address) {
        return ActorSettings.named(address.toString());
    }
}
