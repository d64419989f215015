package io.troupe.actor.testkit;

import io.troupe.actor.Callback;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A callback that records what it hears.
 *
 * <p><b>Role.</b> Made by {@link TestSpace#callback}, and passed to an actor or to a {@link io.troupe.actor.Topic}.
 *
 * {@snippet :
 * CallbackProbe<Integer> colours = test.callback();
 * camera.watch(colours);
 * assertThat(colours.results()).containsExactly(0xFF0000, 0x00FF00);
 * colours.expectFinished();
 * }
 *
 * <p><b>Threads.</b> The test's thread, outside of {@link TestSpace#crank}. Each method that looks first serves what
 * waits in the space.
 *
 * <p><b>Errors.</b> A result or an end that comes after the end is an {@link IllegalStateException} of the sender.
 */
public final class CallbackProbe<T extends @Nullable Object> implements Callback<T> {
    private final TestSpace test;
    private final List<T> results = new ArrayList<>();
    private @Nullable String end;
    private @Nullable Throwable error;
    private boolean cancelled;

    CallbackProbe(TestSpace test) {
        this.test = test;
    }

    /** All results so far. */
    public List<T> results() {
        test.crank();
        return Collections.unmodifiableList(new ArrayList<>(results)); // a result may be null
    }

    /** Expects that it has ended with success. */
    public void expectFinished() {
        test.crank();
        if (end == null || error != null) {
            throw failure("finish()");
        }
    }

    /** Expects that it has ended with an error, and answers that. */
    public Throwable expectFailed() {
        test.crank();
        if (error == null) {
            throw failure("fail(..)");
        }
        return error;
    }

    /** Expects that it has not ended. */
    public void expectOpen() {
        test.crank();
        if (end != null) {
            throw failure("no end");
        }
    }

    /** From now on the sender sees that nobody listens. */
    public void cancel() {
        cancelled = true;
    }

    @Override
    public boolean isCancelled() {
        return cancelled;
    }

    @Override
    @SuppressWarnings("NullAway") // a result is null only if T allows it
    public void accept(@Nullable T result, @Nullable Throwable failure) {
        if (failure != null) {
            checkOpen("fail(" + failure + ")");
            error = failure;
            end = "fail(" + failure + ")";
        } else {
            checkOpen("next(" + result + ")");
            results.add(result);
        }
    }

    @Override
    public void finish() {
        checkOpen("finish()");
        end = "finish()";
    }

    private AssertionError failure(String expected) {
        return new AssertionError("callback: expected " + expected + ", but " + (end == null ? "no end" : end)
                + " came; results so far: " + results);
    }

    private void checkOpen(String what) {
        if (end != null) {
            throw new IllegalStateException(what + " came after the end, " + end);
        }
    }
}
