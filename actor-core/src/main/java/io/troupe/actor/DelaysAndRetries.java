package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.Semaphore;
import java.util.function.BooleanSupplier;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** The promises that a space itself makes: of blocking work, of a delay, and of the end of a loop. */
final class DelaysAndRetries {
    private final SpaceHome space;
    private final Semaphore offloadPlaces;

    DelaysAndRetries(SpaceHome space) {
        this.space = space;
        this.offloadPlaces = new Semaphore(space.settings.offloadLimit(), true);
    }

    /** See {@link ActorSpace#offload}. */
    <T extends @Nullable Object> Promise<T> offload(Callable<? extends T> work) {
        var offloaded = new Offloaded<T>(work);
        offloaded.thread.start();
        return offloaded.answer;
    }

    /** Work on a virtual thread, which only its cancellation interrupts. */
    private final class Offloaded<T extends @Nullable Object> {
        final Callable<? extends T> work;
        final Thread thread = Thread.ofVirtual().name("offload").unstarted(this::run);
        final Deferred<T> answer = new Deferred<>(space, thread::interrupt);

        Offloaded(Callable<? extends T> work) {
            this.work = work;
        }

        private void run() {
            try {
                offloadPlaces.acquire();
            } catch (InterruptedException cancelled) {
                return;
            }
            try {
                if (!answer.isDone()) { // else it was cancelled before it began
                    answer.resolve(work.call());
                }
            } catch (Throwable thrown) {
                answer.reject(thrown);
            } finally {
                offloadPlaces.release();
            }
        }
    }

    /** See {@link ActorSpace#delay}. */
    Promise<@Nullable Void> delay(Duration duration) {
        var delay = new Delay(space);
        delay.withdraw = space.schedule(
                Home.nanosOf(duration),
                () -> delay.over.resolve(null),
                () -> delay.over.reject(new CancellationException(
                        "space " + space + " was closed before the delay of " + duration + " was over")));
        return delay.over;
    }

    /** See {@link ActorSpace#within}. */
    <T extends @Nullable Object> Promise<T> within(Duration limit, Supplier<? extends Promise<? extends T>> question) {
        if (space.isCurrent()) {
            return ask(TimeLimit.of(space, limit, space.limit()), question);
        }
        var common = TimeLimit.of(space, limit, TimeLimit.current());
        var answer = new Deferred<T>(space, null);
        common.limit(answer); // expires in time even if the space is stalled
        space.enqueueMessage(new Entry(
                () -> {
                    space.beginForItself();
                    common.check();
                    if (!answer.isDone()) {
                        answer.resolveFrom(ask(common, question));
                    }
                },
                () -> answer.reject(new CancellationException("space " + space + " was closed before it asked"))));
        return answer;
    }

    private <T extends @Nullable Object> Promise<T> ask(
            TimeLimit common, Supplier<? extends Promise<? extends T>> question) {
        var answer = new Deferred<T>(space, null);
        common.limit(answer);
        TimeLimit before = space.limit();
        space.setLimit(common);
        try {
            answer.resolveFrom(Objects.requireNonNull(question.get(), "the function returned null, not a promise"));
        } catch (Throwable thrown) {
            answer.reject(thrown);
        } finally {
            space.setLimit(before);
        }
        return answer.eventually(common::answered);
    }

    /** See {@link ActorSpace#retry}. */
    <T extends @Nullable Object> Promise<T> retry(
            int tries, Duration pause, Supplier<? extends Promise<? extends T>> attempt) {
        var retrial = new Retry<T>(tries, pause, attempt);
        retrial.tryNow();
        return retrial.end;
    }

    /** See {@link ActorSpace#repeatWhile(BooleanSupplier, Supplier)}; a null promise ends the round at once. */
    Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Supplier<? extends @Nullable Promise<?>> body) {
        space.checkCurrent("repeatWhile(..)");
        var repetition = new RepeatLoop(condition, body);
        repetition.round();
        return repetition.end;
    }

    /**
     * Registers the next step of a loop. If the actor on whose behalf it is registered stops first, the listener is not
     * called, and the loop's promise is rejected.
     */
    private static void next(Promise<?> step, Function<@Nullable Throwable, @Nullable Void> listener, Deferred<?> end) {
        Promise<?> result = step.handle((value, error) -> listener.apply(error));
        Promise.whenSettled(result, end::isDone, () -> {
            Throwable error = result.error();
            if (error != null) {
                end.reject(error);
            }
        });
    }

    /** A promise that is fulfilled by a timer; cancelling it cancels the timer. */
    private static final class Delay {
        final Deferred<@Nullable Void> over;
        volatile @Nullable Runnable withdraw;

        Delay(SpaceHome space) {
            over = new Deferred<>(space, this::withdraw);
        }

        private void withdraw() {
            Runnable timer = withdraw;
            if (timer != null) {
                timer.run();
            }
        }
    }

    /** Repeats an attempt until it succeeds. A loop, so that it retains nothing of failed attempts. */
    private final class Retry<T extends @Nullable Object> {
        final Deferred<T> end;
        private final Duration pause;
        private final Supplier<? extends Promise<? extends T>> attempt;
        private int left;
        private volatile @Nullable Promise<?> pausing;

        Retry(int tries, Duration pause, Supplier<? extends Promise<? extends T>> attempt) {
            this.left = tries;
            this.pause = Objects.requireNonNull(pause, "pause");
            this.attempt = Objects.requireNonNull(attempt, "attempt");
            this.end = new Deferred<>(space, this::cancelled);
        }

        private void cancelled() {
            Promise<?> now = pausing;
            if (now != null) {
                now.cancel();
            }
        }

        void tryNow() {
            Promise<T> trial = Promise.done().thenCompose(begin -> attempt.get());
            next(trial, failure -> ended(trial, failure), end);
        }

        private @Nullable Void ended(Promise<T> trial, @Nullable Throwable failure) {
            if (failure == null) {
                end.resolveFrom(trial);
            } else if (--left == 0) {
                end.reject(failure);
            } else if (!end.isDone()) {
                Promise<?> delay = delay(pause);
                pausing = delay;
                next(delay, this::paused, end);
                if (end.isDone()) {
                    delay.cancel(); // cancelled while the pause began
                }
            }
            return null;
        }

        private @Nullable Void paused(@Nullable Throwable failure) {
            if (failure != null) {
                end.reject(failure);
            } else if (!end.isDone()) {
                tryNow();
            }
            return null;
        }
    }

    /** A loop that shares the thread: each round is one turn of the space. */
    private final class RepeatLoop {
        final Deferred<@Nullable Void> end = new Deferred<>();
        private final BooleanSupplier condition;
        private final Supplier<? extends @Nullable Promise<?>> body;

        RepeatLoop(BooleanSupplier condition, Supplier<? extends @Nullable Promise<?>> body) {
            this.condition = Objects.requireNonNull(condition, "condition");
            this.body = Objects.requireNonNull(body, "body");
        }

        void round() {
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
                    DelaysAndRetries.next(step, this::next, end);
                }
            } catch (Throwable thrown) {
                end.reject(thrown);
            }
        }

        /** Queues the next round as a separate turn, on behalf of the current actor. */
        private void nextTurn(Runnable ifStopped) {
            Incarnation life = space.owner() instanceof Incarnation mine ? mine : null;
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
}
