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

/** Those who stay connected. On the broker's space. */
final class Users {
    /** What a user is told; {@code heard} is settled on the user's side when it has been. */
    record Told(@Nullable ServiceRecord use, @Nullable MissingServiceException lost, Deferred<@Nullable Void> heard) {}

    /** Finds a provider that runs, and answers at once when it knows. */
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
        if (users.size() >= mostBeforeSweep) { // so that those that nothing happens to do not gather
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

    /** Whether a user waits for what this one could give. */
    boolean waitFor(Registration it) {
        return users.stream().anyMatch(user -> user.waits() && it.meets(user.need) && !user.line.isCancelled());
    }

    /** Something may be there now for those who have nothing. */
    void retry(Predicate<Need> met) {
        present(user -> user.waits() && met.test(user.need)).forEach(user -> find(user, false));
    }

    /** Those of some users whose actors still run, in the order of their connecting; the others are forgotten. */
    private List<User> present(Predicate<User> some) {
        List<User> found = new ArrayList<>(users.stream().filter(some).toList());
        found.removeIf(this::isGone);
        return found;
    }

    /** Whether it has disconnected, or its actor has stopped, which ends its connection. */
    private boolean isGone(User user) {
        if (users.contains(user) && user.line.isCancelled()) {
            users.remove(user);
            events.tell(new BrokerEvent.UserGone(user.need));
        }
        return !users.contains(user);
    }

    /**
     * Its users get another provider, or hear that there is none.
     *
     * @return fulfilled when they have heard, or do not listen
     */
    Promise<?> leave(Registration it) {
        var told = new ArrayList<Promise<@Nullable Void>>();
        for (User user : present(each -> each.current == it)) {
            user.current = null;
            told.add(find(user, false));
        }
        return Promise.allSettled(told);
    }

    /** Its users get this other one, if they can use it. */
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
     * The broker is being closed.
     *
     * @return fulfilled when all have heard that there is nothing any more, or do not listen
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
