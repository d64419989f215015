package io.troupe.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentMap;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Actors as services: actors of this process are registered at a broker, and clients call them through the broker by
 * their own interfaces.
 *
 * {@snippet :
 * var space = ActorSpace.create(SpaceSettings.named("ship"));
 * var broker = Broker.open(space, BrokerSettings.defaults());
 * var services = broker.services();
 * services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));
 * var greeter = services.connect(Greeter.class, Need.ofService("guest", "greeter")).actor();
 * show(greeter.greet("Ada").get(Duration.ofSeconds(10)));
 * }
 *
 * <p><b>Role.</b> One per broker: {@link Broker#services}. Actors that are published here can be called through
 * {@link #connect} of the same object, and if the broker has a bus, through that of other processes. An actor can be
 * publisher and subscriber at the same time. A connection that is created outside every actor space is on the space of
 * the broker. The observer of the broker's settings receives events about calls that were not delivered, and about late
 * answers.
 *
 * <p><b>Threads.</b> Any thread.
 *
 * <p><b>Errors.</b> The health check of an actor is an entry in its space's queue, fulfilled after all earlier entries.
 * It detects a space that hangs or is far behind, but only if the broker runs on another space: a broker on the same
 * space hangs with it. An actor that stops, for whatever cause, is detected at once on every space. An actor whose
 * message throws continues and stays healthy, unless its {@link ActorSettings} make it stop.
 *
 * <p>With a bus, methods that publish throw an {@link IllegalArgumentException} if another process cannot call the
 * actor: it has to be published by an interface whose methods return {@code void} or {@link Promise}, or suspend, and
 * whose parameters and results are values, or {@link io.troupe.actor.Callback}s of values. Each actor that runs takes a
 * port of the bus with its name. An exception of an actor arrives in another process as a
 * {@link io.troupe.bus.RemoteFailure}. A one-way call that does not arrive is reported to the observer of the bus.
 *
 * <p><b>Source.</b> Paper, section 1: actors that expose services, each a publisher and a subscriber.
 */
public final class ActorServices {
    /** The exchange of offers with other processes; from any thread. */
    interface Exchange extends RemoteActors.UndeliveredCalls {
        Promise<List<ServiceOffer>> offers(Duration limit);
    }

    private final Broker broker;
    private final String node;
    private final ActorSpace home;
    private final BrokerObserver observer;
    private final @Nullable Bus bus;
    private volatile @Nullable Exchange exchange; // null without a bus
    private final CallableInterfaces interfaces = new CallableInterfaces();
    private final LocalActors actors;
    private final RemoteActors others = new RemoteActors(interfaces);
    private volatile String callerName = "";
    private final AtomicLong callers = new AtomicLong();
    private final ConcurrentMap<String, Integer> published = new ConcurrentHashMap<>();

    /** @param home the space of connections that are created outside every actor space */
    ActorServices(Broker broker, String node, ActorSpace home, BrokerObserver observer, @Nullable Bus bus) {
        this.bus = bus;
        this.actors = new LocalActors(bus, interfaces);
        this.broker = Objects.requireNonNull(broker, "broker");
        this.node = Objects.requireNonNull(node, "node");
        this.home = Objects.requireNonNull(home, "home");
        this.observer = Objects.requireNonNull(observer, "observer");
    }

    /** The actors of this process from now on are offered to others. */
    void exchangeBy(OfferMessages messages, Exchange newExchange) {
        callerName = messages.caller;
        exchange = newExchange;
        others.setOnCheck(newExchange);
    }

    LocalActors actors() {
        return actors;
    }

    RemoteActors others() {
        return others;
    }

    /**
     * Publishes an actor that the broker spawns on demand. Its address is the service's name, from the second actor of
     * the same service on with a number, as {@code camera#2}.
     *
     * @param space where it runs
     * @param type an actor type; clients connect by this interface or one that it extends
     * @param factory creates the actor, on its space, at each start
     */
    public <A> Promise<ServiceRecord> publish(
            ActorSpace space, Class<A> type, String service, List<String> capabilities, Supplier<? extends A> factory) {
        checkCallable(type);
        Address address = nextAddress(service);
        return broker.register(service, capabilities, address, provider(address, space, type, factory, named(address)));
    }

    /**
     * Publishes an existing actor. The broker watches it, but neither starts nor stops it: the code that spawned it
     * does.
     */
    public <A> Promise<ServiceRecord> publishSpawned(
            ActorSpace space, String service, List<String> capabilities, A proxy) {
        Class<?> type = LocalActors.interfaceOf(proxy);
        checkCallable(type);
        Address address = nextAddress(service);
        actors.publish(address, type);
        return broker.register(
                service, capabilities, address, new SpawnedProvider(address, space, proxy, type, actors));
    }

    /** Publishes an actor in place of another one that may be in use; see {@link Broker#replace}. */
    public <A> Promise<ServiceRecord> replace(
            Address old,
            ActorSpace space,
            Class<A> type,
            String service,
            List<String> capabilities,
            Supplier<? extends A> factory) {
        checkCallable(type);
        Address address = nextAddress(service);
        return broker.replace(
                old, service, capabilities, address, provider(address, space, type, factory, named(address)));
    }

    /** A provider for the broker that spawns an actor, with the given address and actor settings. */
    public <A> Provider provider(
            Address address, ActorSpace space, Class<A> type, Supplier<? extends A> factory, ActorSettings settings) {
        actors.publish(address, type);
        return new ActorProvider<>(address, space, type, factory, settings, actors);
    }

    /** Throws if it is no actor type, and if other processes may call the actor, and cannot. */
    private void checkCallable(Class<?> type) {
        if (bus == null) {
            ActorSpace.messages(type);
        } else {
            interfaces.of(type);
        }
    }

    /** Connects with the default limits; see {@link #connect(Class, Need, ConnectionSettings)}. */
    public <A> ActorConnection<A> connect(Class<A> type, Need need) {
        return connect(type, need, ConnectionSettings.defaults());
    }

    /**
     * Connects to the current provider of a service, and after a failover or replacement to the next one.
     *
     * @param type the interface to call; providers must be published by this interface or one that extends it
     * @throws IllegalArgumentException if it is a class
     * @throws io.troupe.actor.ActorTypeException if it is no actor type
     */
    public <A> ActorConnection<A> connect(Class<A> type, Need need, ConnectionSettings settings) {
        if (!type.isInterface()) {
            throw new IllegalArgumentException(
                    "a connection is made by an interface, and " + type.getName() + " is a class: publish it by one");
        }
        ActorSpace current = ActorSpace.current();
        return ActorConnection.open(current == null ? home : current, this, type, need, settings);
    }

    /**
     * Asks all processes on the bus what they offer, and how long a request to each takes.
     *
     * @param limit the time to wait for their offers, and then for their answers; so the result takes this long at
     *     least, and twice as long at most
     * @return fulfilled with the offers of all processes that publish them now, this one included: by service, then by
     *     rank, then by address
     * @throws IllegalStateException if these services have no bus
     */
    public Promise<List<ServiceOffer>> offers(Duration limit) {
        Exchange others = exchange;
        if (others == null) {
            throw new IllegalStateException("these services have no bus: use Broker.over");
        }
        return others.offers(limit);
    }

    Broker broker() {
        return broker;
    }

    BrokerObserver observer() {
        return observer;
    }

    ActorProvider.@Nullable Running running(Address address) {
        return actors.running(address);
    }

    /** The running actor of this process or another one at an address, or null. */
    @Nullable
    RunningActor find(Address address) {
        RunningActor here = actors.running(address);
        return here != null ? here : others.running(address);
    }

    /** Sends the calls of a new connection to other processes. */
    RemoteCaller newCaller() {
        return new RemoteCaller(bus, () -> callerName + "-" + callers.incrementAndGet(), interfaces.values);
    }

    /** A call could not be delivered to an actor of another process. */
    void checkNow(RemoteActor actor) {
        others.checkNow(actor);
    }

    /** The name of a service is a part of its address; numbers and the names of our ports have other characters. */
    private Address nextAddress(String service) {
        if (service.isBlank() || service.chars().anyMatch(c -> "/#$".indexOf(c) >= 0 || Character.isISOControl(c))) {
            throw new IllegalArgumentException("the name of a service is \"" + service
                    + "\", expected a name without / # $ and control characters");
        }
        int number = published.merge(service, 1, Integer::sum);
        return new Address(node, number == 1 ? service : service + "#" + number);
    }

    private static ActorSettings named(Address address) {
        return ActorSettings.named(address.toString());
    }

    /** A provider for an existing actor: the code that spawned the actor also stops it. */
    private static final class SpawnedProvider implements Provider {
        private final ActorSpace space;
        private final Class<?> type;
        private final ActorProvider.Running life;
        private final LocalActors actors;

        SpawnedProvider(Address address, ActorSpace space, Object proxy, Class<?> type, LocalActors actors) {
            this.space = space;
            this.type = type;
            this.life = actors.begin(address, space, proxy);
            this.actors = actors;
        }

        @Override
        public Promise<@Nullable Void> start() {
            if (life.hasEnded()) {
                return Promise.failed(new ProviderException(
                        life.address() + " has stopped; this broker did not spawn it and cannot restart it", null));
            }
            return actors.begun(life, space, type);
        }

        @Override
        public Promise<@Nullable Void> stop() {
            actors.withdraw(life);
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> check() {
            return ActorProvider.check(space, life);
        }

        @Override
        public Promise<@Nullable Void> whenEnded() {
            return ActorProvider.ended(space, life);
        }
    }
}
