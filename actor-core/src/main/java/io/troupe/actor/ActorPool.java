package io.troupe.actor;

import io.troupe.actor.internal.Router;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Objects;
import java.util.function.Supplier;

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
 * <p><b>Threads.</b> Any thread may use the pool and its proxies. Each actor runs on the thread of its space.
 *
 * <p><b>Order.</b> Calls from one sender to one actor are handled in the order in which they were sent. So calls of
 * {@link #byFirstArgument} with equal first arguments keep their order; calls that go to different actors have none.
 *
 * <p><b>Cost.</b> A call of a proxy is a call of the chosen actor's proxy, after that choice. {@link #roundRobin}
 * counts in one counter, which many threads that call at the same time contend for.
 */
public final class ActorPool<A> implements AutoCloseable {
    private final List<ActorSpace> spaces;
    private final List<A> actors;
    private final boolean ownsSpaces;
    private final A roundRobin;
    private final A byFirstArgument;
    private final A broadcast;

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
        roundRobin = proxies.newProxy(Router.roundRobin(actors));
        byFirstArgument = proxies.newProxy(Router.byFirstArgument(actors));
        broadcast = proxies.newProxy(Router.broadcast(actors));
    }

    /**
     * Creates a pool with its own spaces, named after the settings: {@code finder-0}, {@code finder-1} and so on.
     *
     * @param size the number of actors and spaces, usually that of the processors or less
     * @param factory creates one implementation for each actor, on the thread of its space
     */
    public static <A> ActorPool<A> create(
            int size, SpaceSettings settings, Class<A> type, Supplier<? extends A> factory) {
        if (size < 1) {
            throw new IllegalArgumentException("size is " + size + ", expected 1 or more");
        }
        Objects.requireNonNull(settings, "settings");
        List<ActorSpace> spaces = new ArrayList<>();
        try {
            for (int number = 0; number < size; number++) {
                spaces.add(ActorSpace.create(settings.withName(settings.name() + "-" + number)));
            }
            return new ActorPool<>(spaces, true, type, factory, ActorSettings.DEFAULT);
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
     * customer, robot or file. A call of a method without arguments throws {@link UnsupportedOperationException}.
     */
    public A byFirstArgument() {
        return byFirstArgument;
    }

    /**
     * A proxy whose calls go to all actors, with the same arguments. A request is fulfilled when all actors have
     * answered, with the value of the first one, or rejected with the first error. A callback receives the results of
     * all actors, and each of them may end it.
     */
    public A broadcast() {
        return broadcast;
    }

    /** The actor that {@link #byFirstArgument} chooses for a first argument. */
    public A actor(Object key) {
        return actors.get(Router.indexOf(key, actors.size()));
    }

    /** All actors, for example to ask each of them. */
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
            for (int number = 0; number < actors.size(); number++) {
                spaces.get(number).stop(actors.get(number));
            }
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
}
