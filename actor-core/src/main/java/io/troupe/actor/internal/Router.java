package io.troupe.actor.internal;

import org.jspecify.annotations.Nullable;

/**
 * Chooses the actors of a pool that receive a call of one of its proxies. For generated code.
 *
 * <p><b>Threads.</b> Any thread.
 */
public abstract class Router {
    protected Router() {}

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

    /** What the actors receive for an argument that is a callback; before a call. */
    public @Nullable Object callback(@Nullable Object argument) {
        return argument;
    }

    /** Called with what {@link #callback} answered when all actors have received the call. */
    public void called(@Nullable Object callback) {}

    /** The proxy of an actor. */
    public abstract Object actor(int number);
}
