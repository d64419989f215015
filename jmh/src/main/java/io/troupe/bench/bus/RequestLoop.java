package io.troupe.bench.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import java.util.concurrent.CompletableFuture;
import java.util.function.BooleanSupplier;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Sends requests on a space, each after the reply to the one before.
 *
 * @param textOf the text of a reply, which must be as long as expected
 */
record RequestLoop<A>(ActorSpace space, Supplier<Promise<A>> request, Function<A, String> textOf, int expectedLetters) {
    /** Sends one request, and further ones as long as the supplier returns true. Each has a limit, so this ends. */
    void run(BooleanSupplier again) throws Exception {
        var end = new CompletableFuture<@Nullable Void>();
        space.execute(() -> ask(again, end));
        end.get();
    }

    private void ask(BooleanSupplier again, CompletableFuture<@Nullable Void> end) {
        request.get().then((reply, failure) -> {
            if (failure != null) {
                end.completeExceptionally(failure);
            } else if (textOf.apply(reply).length() != expectedLetters) {
                end.completeExceptionally(new IllegalStateException(
                        "the reply has " + textOf.apply(reply).length() + " letters, expected " + expectedLetters));
            } else if (again.getAsBoolean()) {
                ask(again, end);
            } else {
                end.complete(null);
            }
        });
    }
}
