package io.troupe.actor.internal;

import io.troupe.actor.promise.Promise;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;

/**
 * Chooses the actors of a pool that receive a call of one of its proxies. For generated code.
 *
 * <p><b>Threads.</b> Any thread.
 */
public abstract class Router {
    private final List<?> actors;
    private final String text;

    /**
     * Creates a router.
     *
     * @param actors proxies of the same type
     */
    Router(List<?> actors, String text) {
        this.actors = actors;
        this.text = text;
    }

    /** Each call goes to the next actor. */
    public static Router roundRobin(List<?> actors) {
        return new RoundRobin(actors);
    }

    /** Calls with equal first arguments go to the same actor. */
    public static Router byFirstArgument(List<?> actors) {
        return new ByFirstArgument(actors);
    }

    /** Each call goes to all actors. */
    public static Router broadcast(List<?> actors) {
        return new Broadcast(actors);
    }

    /** The number of the first actor that receives a call. */
    public abstract int first(@Nullable Object firstArgument);

    /** The number of the first actor that receives a call without arguments. */
    public int firstWithoutArgument(String method) {
        return first(null);
    }

    /** The number of the next actor that receives the same call, or -1. */
    public int after(int number) {
        return -1;
    }

    /** Throws if a suspend function cannot be called through this router. */
    public void checkSuspending(String method) {}

    public final Object actor(int number) {
        return actors.get(number);
    }

    /** Fulfilled with the value of the first promise when both are fulfilled. */
    @SuppressWarnings("unchecked") // the caller has the same type for all
    public static Promise<?> both(Promise<?> first, Promise<?> second) {
        return Promise.all((List<Promise<Object>>) (List<?>) List.of(first, second))
                .thenApply(values -> values.get(0));
    }

    /** The number of the actor for a key. */
    public static int indexOf(@Nullable Object key, int actors) {
        int hash = key == null ? 0 : key.hashCode() * 0x9E3779B9; // spreads keys that differ in few bits
        return Math.floorMod(hash ^ hash >>> 16, actors);
    }

    final int size() {
        return actors.size();
    }

    @Override
    public final String toString() {
        return text + " of " + actors;
    }

    private static final class RoundRobin extends Router {
        private final AtomicInteger calls = new AtomicInteger();

        RoundRobin(List<?> actors) {
            super(actors, "round robin");
        }

        @Override
        public int first(@Nullable Object firstArgument) {
            return Integer.remainderUnsigned(calls.getAndIncrement(), size());
        }
    }

    private static final class ByFirstArgument extends Router {
        ByFirstArgument(List<?> actors) {
            super(actors, "by first argument");
        }

        @Override
        public int first(@Nullable Object firstArgument) {
            return indexOf(firstArgument, size());
        }

        @Override
        public int firstWithoutArgument(String method) {
            throw new UnsupportedOperationException(
                    method
                            + " has no argument by which one of the actors could be selected: call it on roundRobin(), broadcast() or actor(key)");
        }
    }

    private static final class Broadcast extends Router {
        Broadcast(List<?> actors) {
            super(actors, "broadcast");
        }

        @Override
        public int first(@Nullable Object firstArgument) {
            return 0;
        }

        @Override
        public int after(int number) {
            return number + 1 < size() ? number + 1 : -1;
        }

        @Override
        public void checkSuspending(String method) {
            throw new UnsupportedOperationException(
                    method + " is a suspend function, whose caller waits for one actor: call it on each of actors()");
        }
    }
}
