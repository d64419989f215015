package io.troupe.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.Address;
import java.util.List;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * The broker of one process.
 *
 * <p><b>Role.</b> An actor on a space; uses the clock of that space. Providers may run anywhere. The broker detects a
 * provider that hangs only if it runs on a separate space, and so on another thread.
 *
 * <p><b>Order.</b> Calls from one thread are executed in their order. A call does not wait until an earlier one that
 * takes time, such as a start, is complete.
 *
 * <p><b>Errors.</b> All failures are reported to the observer of the settings, in addition to rejected promises. If the
 * space is closed before the broker, the observer gets an event for each provider that may still run.
 */
public final class ServiceBroker implements Broker {
    private final BrokerProtocol actor;

    private ServiceBroker(BrokerProtocol actor) {
        this.actor = actor;
    }

    /** Opens a broker on that space, with an empty registry. */
    public static ServiceBroker open(ActorSpace space, BrokerSettings settings) {
        Objects.requireNonNull(settings, "settings");
        return new ServiceBroker(space.spawn(
                BrokerProtocol.class, () -> new BrokerActor(space, settings), ActorSettings.named("broker")));
    }

    @Override
    public Promise<ServiceRecord> register(
            String service, List<String> capabilities, Address address, Provider provider) {
        return actor.register(new Registration(service, capabilities, address, provider));
    }

    @Override
    public Promise<@Nullable Void> withdraw(Address provider) {
        return actor.withdraw(provider);
    }

    @Override
    public Promise<ServiceRecord> replace(
            Address old, String service, List<String> capabilities, Address address, Provider provider) {
        return actor.replace(old, new Registration(service, capabilities, address, provider));
    }

    @Override
    public Promise<List<ServiceRecord>> registered() {
        return actor.registered();
    }

    @Override
    public Promise<List<ServiceRecord>> find(Need need) {
        return actor.find(need);
    }

    @Override
    public Promise<ServiceRecord> require(Need need) {
        return actor.require(need);
    }

    @Override
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

    @Override
    public Promise<@Nullable Void> disconnect(Connection connection) {
        return actor.disconnect(connection);
    }

    @Override
    public Promise<List<ServiceRecord>> shutDown() {
        return actor.shutDown();
    }

    @Override
    public void close() {
        shutDown().handle((left, error) -> null); // the observer is notified of providers that did not stop
    }
}
