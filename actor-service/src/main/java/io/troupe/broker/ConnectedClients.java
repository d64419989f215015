package io.troupe.broker;

import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.function.Consumer;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/** The connected clients. Used on the broker's space. */
final class ConnectedClients {
    /** A notification of a client; {@code done} is settled on the client's side when the listener has returned. */
    record Notification(
            @Nullable ServiceRecord use, @Nullable MissingServiceException lost, Deferred<@Nullable Void> done) {}

    /** Chooses a running provider; calls back at once if it is known. */
    interface Chooser {
        void choose(
                Need need, boolean evenFailed, Consumer<ManagedProvider> found, Consumer<MissingServiceException> none);
    }

    private static final class Client {
        final Need need;
        final Broker.Connection connection;
        final Callback<Notification> callback;
        final Deferred<ServiceRecord> first = new Deferred<>();

        @Nullable
        ManagedProvider current;

        @Nullable
        ServiceRecord before;

        @Nullable
        Promise<@Nullable Void> connecting;

        Client(Need need, Broker.Connection connection, Callback<Notification> callback) {
            this.need = need;
            this.connection = connection;
            this.callback = callback;
        }

        boolean waits() {
            return current == null && connecting == null;
        }
    }

    private final Chooser chooser;
    private final Timeouts timeouts;
    private final BrokerSettings settings;
    private final EventPublisher events;
    private final Set<Client> clients = new LinkedHashSet<>();
    private int sweepThreshold = 64;

    ConnectedClients(Chooser chooser, Timeouts timeouts, BrokerSettings settings, EventPublisher events) {
        this.chooser = chooser;
        this.timeouts = timeouts;
        this.settings = settings;
        this.events = events;
    }

    Promise<ServiceRecord> connect(Need need, Broker.Connection connection, Callback<Notification> callback) {
        if (clients.size() >= sweepThreshold) { // removes clients that have stopped and get no other events
            present(client -> true);
            sweepThreshold = Math.max(64, 2 * clients.size());
        }
        var client = new Client(need, connection, callback);
        clients.add(client);
        find(client, true);
        return client.first;
    }

    void disconnect(Broker.Connection connection) {
        clients.removeIf(client -> {
            boolean leaves = client.connection == connection;
            if (leaves) {
                client.first.reject(new MissingServiceException(
                        client.need, "\"" + client.need.by() + "\" has disconnected before there was a provider"));
            }
            return leaves;
        });
    }

    /** Returns whether a client without a provider waits for one that this registration could be. */
    boolean waitFor(ManagedProvider registration) {
        return clients.stream()
                .anyMatch(
                        client -> client.waits() && registration.meets(client.need) && !client.callback.isCancelled());
    }

    /** Looks for a provider again for clients without one, after a provider has become available. */
    void retry(Predicate<Need> met) {
        present(client -> client.waits() && met.test(client.need)).forEach(client -> find(client, false));
    }

    /** Clients that match and whose actors still run, in the order of their connection; stopped ones are removed. */
    private List<Client> present(Predicate<Client> some) {
        List<Client> found = new ArrayList<>(clients.stream().filter(some).toList());
        found.removeIf(this::isGone);
        return found;
    }

    /** Returns whether the client has disconnected, or its actor has stopped, which ends its connection. */
    private boolean isGone(Client client) {
        if (clients.contains(client) && client.callback.isCancelled()) {
            clients.remove(client);
            events.publish(new BrokerEvent.UserGone(client.need));
        }
        return !clients.contains(client);
    }

    /**
     * Moves the clients of a provider to another one, or notifies them that there is none.
     *
     * @return fulfilled when all of them have been notified or have timed out
     */
    Promise<?> leave(ManagedProvider registration) {
        var notified = new ArrayList<Promise<@Nullable Void>>();
        for (Client client : present(each -> each.current == registration)) {
            client.current = null;
            notified.add(find(client, false));
        }
        return Promise.allSettled(notified);
    }

    /** Moves the clients of one provider to another one if it meets their need. */
    Promise<?> move(ManagedProvider from, ManagedProvider to) {
        var notified = new ArrayList<Promise<@Nullable Void>>();
        for (Client client : present(each -> each.current == from)) {
            client.current = null;
            notified.add(to.meets(client.need) ? use(client, to) : find(client, false));
        }
        return Promise.allSettled(notified);
    }

    private Promise<@Nullable Void> find(Client client, boolean evenFailed) {
        var notified = new Deferred<@Nullable Void>();
        client.connecting = notified;
        chooser.choose(
                client.need,
                evenFailed,
                found -> {
                    client.connecting = null;
                    notified.resolveFrom(use(client, found));
                },
                none -> {
                    client.connecting = null;
                    notified.resolveFrom(lose(client, none));
                });
        return notified;
    }

    private Promise<@Nullable Void> use(Client client, ManagedProvider registration) {
        if (isGone(client)) {
            return Promise.done();
        }
        ServiceRecord now = registration.toRecord();
        client.current = registration;
        events.publish(
                client.before == null
                        ? new BrokerEvent.Connected(client.need, now)
                        : new BrokerEvent.FailedOver(client.need, client.before, now));
        client.before = now;
        Promise<@Nullable Void> done = notifyClient(client, now, null);
        client.first.resolve(now);
        return done;
    }

    private Promise<@Nullable Void> lose(Client client, MissingServiceException why) {
        if (client.first.reject(why) || isGone(client)) {
            return Promise.done();
        }
        client.before = null;
        events.publish(new BrokerEvent.Lost(client.need, why));
        return notifyClient(client, null, why);
    }

    private Promise<@Nullable Void> notifyClient(
            Client client, @Nullable ServiceRecord use, @Nullable MissingServiceException lost) {
        var done = new Deferred<@Nullable Void>();
        client.callback.next(new Notification(use, lost, done));
        String overdue = "\"" + client.need.by() + "\" was not notified of "
                + (use == null
                        ? "the loss of its provider"
                        : Objects.requireNonNull(use).provider());
        return timeouts.call(() -> done, settings.notifyLimit(), overdue, late -> {})
                .exceptionally(error -> {
                    events.publish(new BrokerEvent.UserFailed(client.need, error));
                    return null;
                });
    }

    /**
     * Notifies all clients that the broker is shutting down.
     *
     * @return fulfilled when all of them have been notified or have timed out
     */
    Promise<?> endAll() {
        var notified = new ArrayList<Promise<@Nullable Void>>();
        for (Client client : List.copyOf(clients)) {
            client.current = null;
            notified.add(lose(client, ProviderRegistry.closing(client.need)));
        }
        clients.clear();
        return Promise.allSettled(notified);
    }
}
