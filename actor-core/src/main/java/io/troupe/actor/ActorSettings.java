package io.troupe.actor;

import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * How an actor is made; immutable.
 *
 * @param name for messages about it; null = the type's simple name and a number
 * @param onError is told what its one-way messages and timers throw; null = the space's handler is
 */
public record ActorSettings(@Nullable String name, @Nullable ErrorHandler onError) {
    public static final ActorSettings DEFAULT = new ActorSettings(null, null);

    public static ActorSettings named(String name) {
        return new ActorSettings(Objects.requireNonNull(name, "name"), null);
    }

    public ActorSettings withOnError(ErrorHandler handler) {
        return new ActorSettings(name, Objects.requireNonNull(handler, "handler"));
    }
}
