package io.troupe.broker;

import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.Address;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** The broker's actor interface; see {@link Broker}. */
interface BrokerProtocol {
    Promise<ServiceRecord> register(Registration registration);

    Promise<@Nullable Void> withdraw(Address provider);

    Promise<ServiceRecord> replace(Address old, Registration by);

    Promise<List<ServiceRecord>> registered();

    Promise<List<ServiceRecord>> find(Need need);

    Promise<ServiceRecord> require(Need need);

    /** @param callback runs the listener on the client's space; cancelled when the client's actor has stopped */
    Promise<ServiceRecord> connect(
            Need need, Broker.Connection connection, Callback<ConnectedClients.Notification> callback);

    Promise<@Nullable Void> disconnect(Broker.Connection connection);

    Promise<List<ServiceRecord>> shutDown();
}
