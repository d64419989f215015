package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import org.jspecify.annotations.Nullable;

/**
 * What the other modules of this library need of spaces and promises. No API: public only because they are in other
 * packages.
 *
 * @hidden
 */
@SuppressWarnings("exports") // to modules that may see them
public final class LibraryAccess {
    private LibraryAccess() {}

    /** The event loop of a space. */
    public static Home home(ActorSpace space) {
        return space.home();
    }

    /**
     * Creates a deferred of an event loop, or of none.
     *
     * @param ifCancelled runs on the thread that cancels the promise
     */
    public static <T extends @Nullable Object> Deferred<T> deferred(
            @Nullable Home home, @Nullable Runnable ifCancelled) {
        return new Deferred<>(home, ifCancelled);
    }

    /** True if the promise is for {@link Work}. */
    public static boolean isForOneCaller(Promise<?> promise) {
        return promise instanceof Deferred<?> deferred && deferred.isForOneCaller();
    }

    /** Cancels work that one caller alone waits for. The text of this object is the name of its promise. */
    public interface Work extends Runnable {}
}
