package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * Why an actor has ended; see {@link ActorSpace#whenStopped}.
 *
 * {@snippet :
 * space.whenStopped(counter).then(end -> {
 *     switch (end) {
 *         case ActorEnd.Stopped stopped -> log.add("stopped");
 *         case ActorEnd.Failed failed -> log.add("failed: " + failed.error().getMessage());
 *     }
 * });
 * }
 */
public sealed interface ActorEnd {
    /** It was stopped, by itself, by {@link ActorSpace#stop} or because its space was closed. */
    record Stopped() implements ActorEnd {}

    /**
     * Its supervision has stopped it, or its factory threw.
     *
     * @param error the failure that exceeded the limit
     */
    record Failed(Throwable error) implements ActorEnd {}

    static ActorEnd of(@Nullable Throwable failure) {
        return failure == null ? new Stopped() : new Failed(failure);
    }
}
