package io.troupe.actor;

import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.internal.Router;
import io.troupe.actor.internal.SuspendingCalls;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Several actors of one type, each on a separate space, behind proxies that choose among them: the way to use several
 * processors.
 *
 * {@snippet :
 * try (ActorPool<Greeter> pool = ActorPool.create(2, SpaceSettings.named("greeter"), Greeter.class, Polite::new)) {
 *     Greeter next = pool.roundRobin(); // each call goes to the next actor
 *     Greeter same = pool.byFirstArgument(); // calls for one name go to one actor
 *     log.add(next.greet("Ada").get(Duration.ofSeconds(10)));
 *     log.add(same.greet("Ada").get(Duration.ofSeconds(10)));
 * } // closes the spaces
 * }
 *
 * <p><b>Role.</b> The actors share nothing: each has a separate instance, mailbox and supervision. A caller need not
 * know that its proxy is one of a pool.
 *
 * <p><b>End of an actor.</b> An actor that has stopped gets no further calls: the others take its share, and those keys
 * of {@link #byFirstArgument} that were its own, each key always to the same one of them. The other keys stay where
 * they are. Nothing replaces it, so give the actors a {@link Supervision} that restarts them; an actor that is being
 * restarted keeps its place, and its calls wait. Calls that were queued when an actor stopped are rejected, as always.
 * When all have stopped, a request is rejected with an {@link ActorStoppedException} that names the pool, and a one-way
 * message becomes a dead letter. {@link #living} counts those that live.
 *
 * <p><b>Threads.</b> Any thread may use the pool and its proxies. Each actor runs on the thread of its space.
 *
 * <p><b>Order.</b> Calls from one sender to one actor are handled in the order in which they were sent. So calls of
 * {@link #byFirstArgument} with equal first arguments keep their order; calls that go to different actors have none.
 *
 * <p><b>Cost.</b> A call of a proxy is a call of the chosen actor's proxy, after that choice, which reads one volatile
 * field of the actor. {@link #roundRobin} counts in one counter, which many threads that call at the same time contend
 * for.
 */
public final class ActorPool<A> implements AutoCloseable {
    private final List<ActorSpace> spaces;
    private final List<A> actors;
    private final boolean ownsSpaces;
    private final A roundRobin;
    private final A byFirstArgument;
    private final A broadcast;
    private final Members members;
    private final Router byKey;
    private final @Nullable String arrayKey; // why there is no byFirstArgument

    private ActorPool(
            Collection<ActorSpace> spaces,
            boolean ownsSpaces,
            Class<A> type,
            Supplier<? extends A> factory,
            ActorSettings settings) {
        if (spaces.isEmpty()) {
            throw new IllegalArgumentException("spaces is empty, expected one or more");
        }
        this.spaces = List.copyOf(spaces);
        this.ownsSpaces = ownsSpaces;
        var proxies = ActorType.ofPool(type);
        actors = this.spaces.stream()
                .map(space -> space.spawn(type, factory, settings))
                .toList();
        members = new Members(this.spaces, actors, type, settings);
        byKey = new ByFirstArgument(members);
        arrayKey = arrayKey(type);
        roundRobin = proxies.newProxy(new RoundRobin(members));
        byFirstArgument = proxies.newProxy(byKey);
        broadcast = proxies.newProxy(new Broadcast(members));
    }

    private static @Nullable String arrayKey(Class<?> type) {
        return ActorMethods.of(type).messages().stream()
                .filter(method -> {
                    Class<?>[] parameters = SuspendingCalls.parameters(method);
                    return parameters.length > 0 && parameters[0].isArray();
                })
                .findFirst()
                .map(method -> ActorMethods.show(method) + " of actor type " + type.getName()
                        + " has an array as its first argument, by which byFirstArgument() cannot choose, because"
                        + " arrays with equal contents are not equal: let a String, number or record come first, or"
                        + " call actor(key)")
                .orElse(null);
    }

    /**
     * Creates a pool with its own spaces, named after the settings: {@code finder-0}, {@code finder-1} and so on.
     *
     * @param size the number of actors and spaces, usually that of the processors or less
     * @param factory creates one implementation for each actor, on the thread of its space
     */
    public static <A> ActorPool<A> create(
            int size, SpaceSettings settings, Class<A> type, Supplier<? extends A> factory) {
        return create(size, settings, type, factory, ActorSettings.defaults());
    }

    /**
     * Creates a pool with its own spaces; see {@link #create(int, SpaceSettings, Class, Supplier)}.
     *
     * @param actorSettings of each actor
     */
    public static <A> ActorPool<A> create(
            int size,
            SpaceSettings settings,
            Class<A> type,
            Supplier<? extends A> factory,
            ActorSettings actorSettings) {
        if (size < 1) {
            throw new IllegalArgumentException("size is " + size + ", expected 1 or more");
        }
        Objects.requireNonNull(settings, "settings");
        Objects.requireNonNull(actorSettings, "actorSettings");
        List<ActorSpace> spaces = new ArrayList<>();
        try {
            for (int number = 0; number < size; number++) {
                spaces.add(ActorSpace.create(settings.withName(settings.name() + "-" + number)));
            }
            return new ActorPool<>(spaces, true, type, factory, actorSettings);
        } catch (Throwable broken) { // for example a type that cannot be an actor type
            spaces.forEach(ActorSpace::close);
            throw broken;
        }
    }

    /**
     * Creates a pool on spaces that belong to the caller, one actor on each.
     *
     * @param settings of each actor
     */
    public static <A> ActorPool<A> on(
            Collection<ActorSpace> spaces, Class<A> type, Supplier<? extends A> factory, ActorSettings settings) {
        return new ActorPool<>(spaces, false, type, factory, settings);
    }

    /** A proxy whose calls go to the actors in turn. */
    public A roundRobin() {
        return roundRobin;
    }

    /**
     * A proxy whose calls go to the actor that the first argument selects, by its {@code hashCode}: an actor for each
     * customer, robot or file. A call of a method without arguments throws {@link UnsupportedOperationException}, one
     * with an array as its first argument {@link IllegalArgumentException}.
     *
     * @throws ActorTypeException if the first argument of a method is an array: equal ones would select different
     *     actors
     */
    public A byFirstArgument() {
        if (arrayKey != null) {
            throw new ActorTypeException(arrayKey);
        }
        return byFirstArgument;
    }

    /**
     * A proxy whose calls go to all actors that live, with the same arguments. A request is fulfilled when all of them
     * have answered, with the value of the first one, or rejected with the first error; cancelling it cancels the
     * request to each of them. A callback receives the results of all of them, and ends with the first error, or
     * without one when the last of them has finished. For a caller outside every space it runs on the space of the
     * first of them.
     */
    public A broadcast() {
        return broadcast;
    }

    /** The actor that {@link #byFirstArgument} chooses for a first argument now. */
    @SuppressWarnings("unchecked") // the proxies are of type A
    public A actor(Object key) {
        return (A) byKey.actor(byKey.first(key));
    }

    /** The number of actors that have not stopped. */
    public int living() {
        return members.living();
    }

    /** All actors, also those that have stopped, for example to watch each of them. */
    public List<A> actors() {
        return actors;
    }

    /** The spaces of the actors, in the same order. */
    public List<ActorSpace> spaces() {
        return spaces;
    }

    /**
     * Closes the spaces if {@link #create} made them; see {@link ActorSpace#close()}. Otherwise stops the actors, as
     * {@link ActorSpace#stop} does, and does not wait for that.
     */
    @Override
    public void close() {
        if (!ownsSpaces) {
            actors.forEach(actor -> ActorSpace.of(actor).stop(actor));
            return;
        }
        RuntimeException first = null;
        for (ActorSpace space : spaces) {
            try {
                space.close();
            } catch (RuntimeException busy) { // the others are closed all the same
                if (first == null) {
                    first = busy;
                } else {
                    first.addSuppressed(busy);
                }
            }
        }
        if (first != null) {
            throw first;
        }
    }

    @Override
    public String toString() {
        return "pool of " + actors;
    }

    /** The actors of a pool, by their numbers; the last number stands for the pool when all of them have stopped. */
    private static final class Members {
        private final List<?> actors;
        private final Object[] proxies;
        private final ActorCell[] cells;

        <A> Members(List<ActorSpace> spaces, List<A> actors, Class<A> type, ActorSettings settings) {
            this.actors = actors;
            cells = actors.stream()
                    .map(actor -> (ActorCell) ((ActorProxy) actor).troupe$cell())
                    .toArray(ActorCell[]::new);
            String name = "pool of " + actors.size() + " " + cells[0].label();
            var end = new ActorCell(spaces.getFirst().home, type, 0, () -> null, ActorSettings.named(name));
            A endProxy = ActorType.of(type).newProxy(end);
            end.bind(endProxy);
            end.standForPool();
            List<Object> all = new ArrayList<>(actors);
            all.add(endProxy);
            proxies = all.toArray();
        }

        int size() {
            return cells.length;
        }

        boolean lives(int number) {
            return !cells[number].hasStopped();
        }

        int living() {
            int living = 0;
            for (int number = 0; number < cells.length; number++) {
                living += lives(number) ? 1 : 0;
            }
            return living;
        }

        /** The first number from this one on whose actor lives; that of the pool if there is none. */
        int livingFrom(int number) {
            int next = number;
            while (next < cells.length && !lives(next)) {
                next++;
            }
            return next;
        }

        SpaceHome firstSpace() {
            return cells[livingFrom(0) % cells.length].space();
        }
    }

    private abstract static class PoolRouter extends Router {
        final Members members;
        private final String text;

        PoolRouter(Members members, String text) {
            this.members = members;
            this.text = text;
        }

        @Override
        public final Object actor(int number) {
            return members.proxies[number];
        }

        @Override
        public final String toString() {
            return text + " of " + members.actors;
        }
    }

    private static final class RoundRobin extends PoolRouter {
        private final AtomicInteger calls = new AtomicInteger();

        RoundRobin(Members members) {
            super(members, "round robin");
        }

        @Override
        public int first(@Nullable Object firstArgument) {
            int number = next();
            return members.lives(number) ? number : nextThatLives();
        }

        private int next() {
            return Integer.remainderUnsigned(calls.getAndIncrement(), members.size());
        }

        /** Passes over the turns of those that have stopped, so that the others have equal shares. */
        private int nextThatLives() {
            for (int tries = 1; tries < members.size(); tries++) {
                int number = next();
                if (members.lives(number)) {
                    return number;
                }
            }
            return members.livingFrom(0); // callers on other threads may have taken the turns of those that live
        }
    }

    private static final class ByFirstArgument extends PoolRouter {
        private static final int SPREAD = 0x9E3779B9; // makes hash codes differ in many bits

        ByFirstArgument(Members members) {
            super(members, "by first argument");
        }

        @Override
        public int first(@Nullable Object firstArgument) {
            if (firstArgument != null && firstArgument.getClass().isArray()) {
                throw new IllegalArgumentException("the key is an array, "
                        + firstArgument.getClass().getSimpleName()
                        + ", expected a value whose equals(..) compares contents: a String, number or record");
            }
            int hash = firstArgument == null ? 0 : firstArgument.hashCode() * SPREAD;
            int number = Math.floorMod(hash ^ hash >>> 16, members.size());
            return members.lives(number) ? number : heir(hash);
        }

        /**
         * The actor for a key whose own one has stopped: the one with the greatest weight, which depends on the key and
         * that actor alone. So a key moves only when its actor stops, and the keys of one actor go to all others.
         */
        private int heir(int hash) {
            int heir = members.size();
            int greatest = Integer.MIN_VALUE;
            for (int number = 0; number < members.size(); number++) {
                int weight = mixed(hash + number * SPREAD);
                if (members.lives(number) && (heir == members.size() || weight > greatest)) {
                    heir = number;
                    greatest = weight;
                }
            }
            return heir;
        }

        private static int mixed(int bits) {
            int half = (bits ^ bits >>> 15) * SPREAD;
            return (half ^ half >>> 13) * SPREAD;
        }

        @Override
        public int firstWithoutArgument(String method) {
            throw new UnsupportedOperationException(
                    method
                            + " has no argument by which one of the actors could be selected: call it on roundRobin(), broadcast() or actor(key)");
        }
    }

    private static final class Broadcast extends PoolRouter {
        Broadcast(Members members) {
            super(members, "broadcast");
        }

        @Override
        public int first(@Nullable Object firstArgument) {
            return members.livingFrom(0);
        }

        @Override
        public int after(int number) {
            int next = members.livingFrom(number + 1);
            return next < members.size() ? next : -1;
        }

        @Override
        public @Nullable Object callback(@Nullable Object argument) {
            return argument == null ? null : new BroadcastCallback<>((Callback<?>) argument, members.firstSpace());
        }

        @Override
        public void called(@Nullable Object callback) {
            if (callback instanceof BroadcastCallback<?> shared) {
                shared.finish();
            }
        }

        @Override
        public void checkSuspending(String method) {
            throw new UnsupportedOperationException(
                    method + " is a suspend function, whose caller waits for one actor: call it on each of actors()");
        }
    }
}
