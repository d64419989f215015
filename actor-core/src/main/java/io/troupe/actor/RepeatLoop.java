package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.BooleanSupplier;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** A loop that shares the thread: each round is one turn of the space. */
final class RepeatLoop {
    private final ActorSpace space;
    private final BooleanSupplier condition;
    private final Supplier<? extends @Nullable Promise<?>> body;
    private final Deferred<@Nullable Void> end = new Deferred<>();

    private RepeatLoop(ActorSpace space, BooleanSupplier condition, Supplier<? extends @Nullable Promise<?>> body) {
        this.space = space;
        this.condition = Objects.requireNonNull(condition, "condition");
        this.body = Objects.requireNonNull(body, "body");
    }

    static Promise<@Nullable Void> start(
            ActorSpace space, BooleanSupplier condition, Supplier<? extends @Nullable Promise<?>> body) {
        space.checkCurrent("repeatWhile(..)");
        var repetition = new RepeatLoop(space, condition, body);
        repetition.round();
        return repetition.end;
    }

    private void round() {
        try {
            if (end.isDone()) {
                return; // cancelled
            }
            if (!condition.getAsBoolean()) {
                end.resolve(null);
                return;
            }
            Promise<?> step = body.get();
            if (step == null) {
                nextTurn(() -> end.reject(new CancellationException("the actor of this loop has stopped")));
            } else {
                Retry.next(space, step, this::next, end);
            }
        } catch (Throwable thrown) {
            end.reject(thrown);
        }
    }

    /** Queues the next round as a separate turn, on behalf of the current actor. */
    private void nextTurn(Runnable ifStopped) {
        Incarnation life = space.currentOwner() instanceof Incarnation mine ? mine : null;
        space.enqueueMessage(new Entry(
                () -> {
                    if (life == null) {
                        space.runGuarded(this::round);
                    } else if (!life.run("a repetition", this::round)) {
                        ifStopped.run();
                    }
                },
                ifStopped));
    }

    private @Nullable Void next(@Nullable Throwable error) {
        if (error == null) {
            round();
        } else {
            end.reject(error);
        }
        return null;
    }
}
