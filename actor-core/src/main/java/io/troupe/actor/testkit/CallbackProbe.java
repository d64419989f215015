package io.troupe.actor.testkit;

import io.troupe.actor.Callback;
import io.troupe.actor.internal.CancellationFlag;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A callback that records the results and the end that it receives.
 *
 * <p><b>Role.</b> Created by {@link TestSpace#callback}, and passed to an actor or to a {@link io.troupe.actor.Topic}.
 *
 * {@snippet :
 * CallbackProbe<Integer> colours = test.callback();
 * camera.watch(colours);
 * assertThat(colours.results()).containsExactly(0xFF0000, 0x00FF00);
 * colours.expectFinished();
 * }
 *
 * <p><b>Threads.</b> The test's thread, outside of {@link TestSpace#runQueued}. Each method that checks or reads first
 * runs everything that is queued in the space.
 *
 * <p><b>Errors.</b> A result or an end after the end throws an {@link IllegalStateException} to the sender.
 */
@SuppressWarnings("exports") // a cancellation flag is a callback of this library, not an interface for users
public final class CallbackProbe<T extends @Nullable Object> implements Callback<T>, CancellationFlag {
    private final TestSpace test;
    private final List<T> results = new ArrayList<>();
    private @Nullable String end;
    private @Nullable Throwable error;
    private volatile boolean cancelled;

    CallbackProbe(TestSpace test) {
        this.test = test;
    }

    /** All results so far. */
    public List<T> results() {
        test.runQueued();
        return Collections.unmodifiableList(new ArrayList<>(results)); // a result may be null
    }

    /** Asserts that it has finished without an error. */
    public void expectFinished() {
        test.runQueued();
        if (end == null || error != null) {
            throw failure("finish()");
        }
    }

    /** Asserts that it has ended with an error, and returns the error. */
    public Throwable expectFailed() {
        test.runQueued();
        if (error == null) {
            throw failure("fail(..)");
        }
        return error;
    }

    /** Asserts that it has not ended. */
    public void expectOpen() {
        test.runQueued();
        if (end != null) {
            throw failure("no end");
        }
    }

    /** Makes {@link #isCancelled} return true: the sender sees that results are no longer wanted. */
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
            checkOpen("fail(" + Probe.show(failure) + ")");
            error = failure;
            end = "fail(" + Probe.show(failure) + ")";
        } else {
            checkOpen("next(" + Probe.show(result) + ")");
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
                + " came; results so far: " + results.stream().map(Probe::show).toList());
    }

    private void checkOpen(String what) {
        if (end != null) {
            throw new IllegalStateException(what + " came after the end, " + end);
        }
    }
}
