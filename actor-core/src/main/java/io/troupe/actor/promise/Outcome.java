package io.troupe.actor.promise;

import org.jspecify.annotations.Nullable;

/** How a promise ended. */
public sealed interface Outcome<T extends @Nullable Object> {
    record Fulfilled<T extends @Nullable Object>(T value) implements Outcome<T> {}

    record Rejected<T extends @Nullable Object>(Throwable error) implements Outcome<T> {}
}
