package io.troupe.actor.promise;

import io.troupe.actor.internal.loop.Home;
import org.jspecify.annotations.Nullable;

/**
 * The thread on which promises run their listeners: the base class of {@code ActorSpace}.
 *
 * <p>Users meet it as the parameter of {@link Deferred}, to which they pass a space.
 *
 * <p><b>Role.</b> Names the space in signatures of this package, which does not know actors. Users never extend this
 * class; it has no public members for them.
 */
public abstract class EventLoop {
    private final Home home;

    /** @hidden */
    protected EventLoop(Home home) {
        this.home = home;
    }

    /**
     * The internal side of a space, or null for no space.
     *
     * @hidden
     */
    public static @Nullable Home homeOf(@Nullable EventLoop space) {
        return space == null ? null : space.home;
    }
}
