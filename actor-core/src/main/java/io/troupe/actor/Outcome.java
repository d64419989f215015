package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * How a promise ended.
 *
 * {@snippet :
 * Promise.allSettled(List.of(first, second)).then(outcomes -> {
 *     for (Outcome<String> outcome : outcomes) {
 *         log.add(
 *                 switch (outcome) {
 *                     case Outcome.Fulfilled<String>(var value) -> value;
 *                     case Outcome.Rejected<String>(var error) -> error.getMessage();
 *                 });
 *     }
 * });
 * }
 */
public sealed interface Outcome<T extends @Nullable Object> {
    record Fulfilled<T extends @Nullable Object>(T value) implements Outcome<T> {}

    record Rejected<T extends @Nullable Object>(Throwable error) implements Outcome<T> {}
}
