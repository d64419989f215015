package io.troupe.services.broker;

import io.troupe.actor.Callback;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.function.Consumer;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/** The connected clients. Used on the broker's space. */
final class Users {
    /** A notification of a client; {@code heard} is settled on the client's side when the listener has returned. */
    record Told(@Nullable ServiceRecord use, @Nullable MissingServiceException lost, Deferred<@Nullable Void> heard) {}

    /** Chooses a running provider; calls back at once if it is known. */
    interface Chooser {
        void choose(
                Need need, boolean evenFailed, Consumer<Registration> found, Consumer<MissingServiceException> none);
    }

    private static final class User {
        final Need need;
        final Broker.Connection connection;
        final Callback<Told> line;
        final Deferred<ServiceRecord> first = new Deferred<>();

        @Nullable
        Registration current;

        @Nullable
        ServiceRecord before;

        @Nullable
        Promise<@Nullable Void> connecting;

        User(Need need, Broker.Connection connection, Callback<Told> line) {
            this.need = need;
            this.connection = connection;
            this.line = line;
        }

        boolean waits() {
            return current == null && connecting == null;
        }
    }

    private final Chooser chooser;
    private final Limits limits;
    private final BrokerSettings settings;
    private final Events events;
    private final Set<User> users = new LinkedHashSet<>();
    private int mostBeforeSweep = 64;

    Users(Chooser chooser, Limits limits, BrokerSettings settings, Events events) {
        this.chooser = chooser;
        this.limits = limits;
        this.settings = settings;
        this.events = events;
    }

    Promise<ServiceRecord> connect(Need need, Broker.Connection connection, Callback<Told> line) {
        if (users.size() >= mostBeforeSweep) { // removes clients that have stopped and get no other events
            present(user -> true);
            mostBeforeSweep = Math.max(64, 2 * users.size());
        }
        var user = new User(need, connection, line);
        users.add(user);
        find(user, true);
        return user.first;
    }

    void disconnect(Broker.Connection connection) {
        users.removeIf(user -> {
            boolean leaves = user.connection == connection;
            if (leaves) {
                user.first.reject(new MissingServiceException(
                        user.need, "\"" + user.need.by() + "\" has disconnected before there was a provider"));
            }
            return leaves;
        });
    }

    /** Returns whether a client without a provider waits for one that this registration could be. */
    boolean waitFor(Registration it) {
        return users.stream().anyMatch(user -> user.waits() && it.meets(user.need) && !user.line.isCancelled());
    }

    /** Looks for a provider again for clients without one, after a provider has become available. */
    void retry(Predicate<Need> met) {
        present(user -> user.waits() && met.test(user.need)).forEach(user -> find(user, false));
    }

    /** Clients that match and whose actors still run, in the order of their connection; stopped ones are removed. */
    private List<User> present(Predicate<User> some) {
        List<User> found = new ArrayList<>(users.stream().filter(some).toList());
        found.removeIf(this::isGone);
        return found;
    }

    /** Returns whether the client has disconnected, or its actor has stopped, which ends its connection. */
    private boolean isGone(User user) {
        if (users.contains(user) && user.line.isCancelled()) {
            users.remove(user);
            events.tell(new BrokerEvent.UserGone(user.need));
        }
        return !users.contains(user);
    }

    /**
     * Moves the clients of a provider to another one, or notifies them that there is none.
     *
     * @return fulfilled when all of them have been notified or have timed out
     */
    Promise<?> leave(Registration it) {
        var told = new ArrayList<Promise<@Nullable Void>>();
        for (User user : present(each -> each.current == it)) {
            user.current = null;
            told.add(find(user, false));
        }
        return Promise.allSettled(told);
    }

    /** Moves the clients of one provider to another one if it meets their need. */
    Promise<?> move(Registration from, Registration to) {
        var told = new ArrayList<Promise<@Nullable Void>>();
        for (User user : present(each -> each.current == from)) {
            user.current = null;
            told.add(to.meets(user.need) ? use(user, to) : find(user, false));
        }
        return Promise.allSettled(told);
    }

    private Promise<@Nullable Void> find(User user, boolean evenFailed) {
        var told = new Deferred<@Nullable Void>();
        user.connecting = told;
        chooser.choose(
                user.need,
                evenFailed,
                found -> {
                    user.connecting = null;
                    told.resolveFrom(use(user, found));
                },
                none -> {
                    user.connecting = null;
                    told.resolveFrom(lose(user, none));
                });
        return told;
    }

    private Promise<@Nullable Void> use(User user, Registration it) {
        if (isGone(user)) {
            return Promise.done();
        }
        ServiceRecord now = it.toRecord();
        user.current = it;
        events.tell(
                user.before == null
                        ? new BrokerEvent.Connected(user.need, now)
                        : new BrokerEvent.FailedOver(user.need, user.before, now));
        user.before = now;
        Promise<@Nullable Void> heard = tell(user, now, null);
        user.first.resolve(now);
        return heard;
    }

    private Promise<@Nullable Void> lose(User user, MissingServiceException why) {
        if (user.first.reject(why) || isGone(user)) {
            return Promise.done();
        }
        user.before = null;
        events.tell(new BrokerEvent.Lost(user.need, why));
        return tell(user, null, why);
    }

    private Promise<@Nullable Void> tell(
            User user, @Nullable ServiceRecord use, @Nullable MissingServiceException lost) {
        var heard = new Deferred<@Nullable Void>();
        user.line.next(new Told(use, lost, heard));
        String overdue = "\"" + user.need.by() + "\" did not hear of "
                + (use == null
                        ? "the loss of its provider"
                        : Objects.requireNonNull(use).provider());
        return limits.ask(() -> heard, settings.hearLimit(), overdue, late -> {})
                .exceptionally(error -> {
                    events.tell(new BrokerEvent.UserFailed(user.need, error));
                    return null;
                });
    }

    /**
     * Notifies all clients that the broker is shutting down.
     *
     * @return fulfilled when all of them have been notified or have timed out
     */
    Promise<?> endAll() {
        var told = new ArrayList<Promise<@Nullable Void>>();
        for (User user : List.copyOf(users)) {
            user.current = null;
            told.add(lose(user, Roster.closing(user.need)));
        }
        users.clear();
        return Promise.allSettled(told);
    }
}
