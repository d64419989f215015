package io.troupe.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.internal.OwnName;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.TimeoutException;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The service registry: finds providers, starts them on demand, checks their health, and notifies connected clients
 * when another provider takes over.
 *
 * {@snippet :
 * Broker broker = Broker.open(space, BrokerSettings.defaults().withObserver(observer));
 * broker.register("camera", List.of("senses", "colour"), new Address("robot", "left"), left);
 * broker.register("camera", List.of("senses"), new Address("robot", "right"), right);
 *
 * broker.require(Need.ofService("finder", "camera")).then(camera -> show(camera.provider()));
 * }
 *
 * <p><b>Role.</b> One per process. Uses the clock of its space. Providers may run anywhere. The broker detects a
 * provider that hangs only if it runs on a separate space, and so on another thread.
 *
 * <p><b>Threads.</b> Methods may be called from any thread; listeners run on the actor space on which they were
 * registered.
 *
 * <p><b>Order.</b> Calls from one thread are executed in their order. A call does not wait until an earlier one that
 * takes time, such as a start, is complete.
 *
 * <p><b>Errors.</b> A need without a provider is rejected with a {@link MissingServiceException}. All failures are
 * reported to the observer of the settings, in addition to rejected promises. If the space is closed before the broker,
 * the observer gets an event for each provider that may still run.
 *
 * <p><b>Source.</b> Paper, section 2.2.4; "in case a service is not present the system should terminate gracefully",
 * section 1.
 */
public final class Broker implements AutoCloseable {
    /** The listener of a connection: is notified which provider to use. */
    public interface Connection {
        /** Use this provider from now on. */
        void use(ServiceRecord provider);

        /** There is no provider at the moment; {@link #use} may follow later. */
        void lost(MissingServiceException why);
    }

    private final BrokerActor actor;
    private final ActorServices services;
    private final BrokerSettings settings;

    private Broker(String node, ActorSpace space, BrokerSettings settings, @Nullable Bus bus) {
        Objects.requireNonNull(settings, "settings");
        this.settings = settings;
        this.actor =
                space.spawn(BrokerActor.class, () -> new BrokerActor(space, settings), ActorSettings.named("broker"));
        this.services = new ActorServices(this, node, space, settings.observer(), bus);
    }

    /**
     * Opens a broker on that space, with an empty registry. The name of the space is that of this process in the
     * addresses of actors.
     */
    public static Broker open(ActorSpace space, BrokerSettings settings) {
        return open(space.toString(), space, settings);
    }

    /**
     * Opens a broker on that space, with an empty registry.
     *
     * @param node the name of this process in the addresses of actors
     */
    public static Broker open(String node, ActorSpace space, BrokerSettings settings) {
        return new Broker(node, space, settings, null);
    }

    /**
     * Opens a broker that exchanges offers with the brokers of other processes on a bus: it registers what they offer,
     * and each starts only the providers of its process.
     *
     * {@snippet :
     * var bus = Bus.open("ship", engine, BusSettings.on(space));
     * var broker = Broker.over(bus, space, BrokerSettings.defaults());
     * var services = broker.services();
     * services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));
     * }
     *
     * <p><b>Role.</b> Once per bus, or once per group ({@link Sharing#withGroup}). Of providers that are equally
     * healthy it chooses the one with the least rank, then the one whose node's name comes first, then the one that was
     * registered first, in every process alike.
     *
     * <p><b>Errors.</b> A process that has not renewed its offers for 3 s is suspect, and after 10 s its providers are
     * withdrawn. Requests to the broker of another process have three quarters of the limits of the settings.
     */
    public static Broker over(Bus bus, ActorSpace space, BrokerSettings settings) {
        return over(bus, space, settings, Sharing.defaults());
    }

    /** The same, with a rank or in a group. */
    public static Broker over(Bus bus, ActorSpace space, BrokerSettings settings, Sharing sharing) {
        Objects.requireNonNull(space, "space");
        Objects.requireNonNull(settings, "settings");
        var messages = new OfferMessages(sharing.group());
        BusPort port = bus.attach(new OwnName(messages.port));
        var broker = new Broker(bus.node(), space, settings, bus);
        long incarnation = new SecureRandom().nextLong(1, 1L << 53); // exact in every language
        ActorServices services = broker.services;
        var context =
                new OfferedProvider.Context(bus, port, settings, sharing, services.others(), messages, incarnation);
        services.exchangeBy(
                messages,
                space.spawn(
                        ActorServices.Exchange.class,
                        () -> new OfferExchange(context, broker.actor, services.actors()),
                        ActorSettings.named("broker's offers")));
        return broker;
    }

    /** The actors of this process that are services, and connections to services. */
    public ActorServices services() {
        return services;
    }

    /**
     * Registers a provider of a service. It is started on demand. If a provider at the same address, or the same
     * {@code provider}, was withdrawn or replaced before and has not stopped yet, that one is stopped at once when the
     * new one is needed, and the new one is started when it has stopped or its time limit is over. Connected clients
     * without a provider are connected to the new one.
     *
     * @param capabilities may be empty
     * @return rejected with an {@link IllegalArgumentException} if the address is already registered
     */
    public Promise<ServiceRecord> register(
            String service, List<String> capabilities, Address address, Provider provider) {
        return actor.register(service, List.copyOf(capabilities), address, ManagedProvider.Source.of(provider));
    }

    /**
     * The same with a provider that has an object for each of its lives. No life begins before all earlier ones have
     * been stopped; if one cannot be stopped, the start is rejected, and the next start tries it again.
     *
     * @param lives creates the provider of the next life, on the broker's space
     */
    public Promise<ServiceRecord> register(
            String service, List<String> capabilities, Address address, Supplier<? extends Provider> lives) {
        return actor.register(service, List.copyOf(capabilities), address, ManagedProvider.Source.of(lives));
    }

    /**
     * Withdraws a provider. Its clients get another provider, or are notified that there is none; then it is stopped. A
     * start of it that is still waiting for the stop of another provider is dropped.
     *
     * @return fulfilled when it has stopped; rejected with a {@link ProviderException} if it does not stop, and with an
     *     {@link IllegalArgumentException} if the address is not registered
     */
    public Promise<@Nullable Void> withdraw(Address provider) {
        return actor.withdraw(provider);
    }

    /**
     * Replaces a provider at run time: the new one is started, clients are notified, then the old one is stopped. The
     * new provider keeps the old one's position in the order of registration, and may have the same address. The
     * replaced provider can be registered again at any time: it is stopped and started again as described at
     * {@link #register}.
     *
     * @return fulfilled when the replacement is complete; rejected with a {@link ProviderException} if the new provider
     *     cannot be started, in which case the old one stays in use; with an {@link IllegalStateException} if the old
     *     one is already being replaced
     */
    public Promise<ServiceRecord> replace(
            Address old, String service, List<String> capabilities, Address address, Provider provider) {
        return actor.replace(old, service, List.copyOf(capabilities), address, ManagedProvider.Source.of(provider));
    }

    /** The same with a provider that has an object for each of its lives. */
    public Promise<ServiceRecord> replace(
            Address old,
            String service,
            List<String> capabilities,
            Address address,
            Supplier<? extends Provider> lives) {
        return actor.replace(old, service, List.copyOf(capabilities), address, ManagedProvider.Source.of(lives));
    }

    /**
     * The same with a provider that another process offers and that is not in use. It is registered for that service
     * only.
     */
    public Promise<ServiceRecord> replace(Address old, String service, List<String> capabilities, Address offered) {
        return actor.replaceByOffered(old, service, List.copyOf(capabilities), offered);
    }

    /** All registered providers, in the order of registration. */
    public Promise<List<ServiceRecord>> registered() {
        return actor.registered();
    }

    /**
     * All providers that meet a need, best first: healthy before suspect, then in the order of registration. Starts
     * nothing.
     */
    public Promise<List<ServiceRecord>> find(Need need) {
        return actor.find(need);
    }

    /**
     * Returns one running provider: healthy before suspect. If none runs, the first one that can be started, those that
     * have failed before last. Concurrent callers with the same need share one start.
     *
     * @return rejected with a {@link MissingServiceException} that names each provider and why it does not run
     */
    public Promise<ServiceRecord> require(Need need) {
        return actor.require(need);
    }

    /**
     * Connects a client: the listener is notified of the provider to use, first now, and again whenever another one
     * takes its place because the provider failed, was withdrawn or was replaced. The connection ends with
     * {@link #disconnect}, or when the calling actor stops.
     *
     * @return fulfilled with the first provider; rejected with a {@link MissingServiceException} if there is none now.
     *     The connection stays open even then, and its listener is notified when there is a provider
     */
    public Promise<ServiceRecord> connect(Need need, Connection connection) {
        Objects.requireNonNull(connection, "connection");
        return actor.connect(need, connection, callbackFor(connection));
    }

    /**
     * Calls the listener and confirms this to the broker: only then may the provider that the client used before be
     * stopped.
     */
    private static Callback<ConnectedClients.Notification> callbackFor(Connection connection) {
        return (notification, error) -> {
            if (notification == null) {
                return; // the broker's space was closed
            }
            try {
                if (notification.use() != null) {
                    connection.use(notification.use());
                } else if (notification.lost() != null) {
                    connection.lost(notification.lost());
                }
                notification.done().resolve(null);
            } catch (RuntimeException thrown) {
                notification.done().reject(thrown); // reported to the observer
            } catch (Error thrown) {
                notification.done().reject(thrown);
                throw thrown;
            }
        };
    }

    /** Ends a connection: its listener is not called any more. Providers keep running without connections. */
    public Promise<@Nullable Void> disconnect(Connection connection) {
        return actor.disconnect(connection);
    }

    /**
     * Notifies clients that there is no provider any more, then stops all providers that the broker has started, one by
     * one in reverse order of their starts, each within its limit. From this call on, methods that start or change
     * something are rejected with an {@link IllegalStateException}; {@link #registered} and {@link #find} still return
     * the known state, {@link #disconnect} has no effect, and another close returns the same promise.
     *
     * @return fulfilled, when that is done, with the providers that did not stop
     */
    public Promise<List<ServiceRecord>> closeAsync() {
        return actor.shutDown();
    }

    /**
     * Like {@link #closeAsync}, and waits until that is done: for threads outside every space. On the thread of a space
     * it does not wait. The observer is notified of providers that did not stop. It ends in bounded time: each provider
     * may take the limits of the settings for a start that is under way and for its stop.
     *
     * @throws ProviderException if it takes longer than all these limits together; it goes on
     */
    @Override
    public void close() {
        var started = registered().thenApply(List::size).exceptionally(closed -> 0); // before it closes
        Promise<?> closed = closeAsync().handle((left, error) -> true); // left ones are events
        if (ActorSpace.current() != null) {
            return;
        }
        // each: a start that is under way, the stop after it has failed, and the stop of the broker
        Duration each = settings.startLimit().plus(settings.stopLimit().multipliedBy(2));
        Duration limit = settings.notifyLimit().plus(each);
        try {
            limit = settings.notifyLimit().plus(each.multipliedBy(Math.max(1, started.get(each))));
            closed.get(limit);
        } catch (TimeoutException late) {
            throw new ProviderException("the broker has not been closed within " + limit + "; it goes on", late);
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
        }
    }
}
