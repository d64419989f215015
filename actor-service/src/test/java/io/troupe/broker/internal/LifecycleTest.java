package io.troupe.broker.internal;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.internal.Lifecycle.State;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The machine that providers and components share; their tests have the details. */
class LifecycleTest {
    private final TestSpace test = new TestSpace();
    private final List<String> calls = new ArrayList<>();
    private final Scripted lifecycle = new Scripted();

    @AfterEach
    void close() {
        test.close();
    }

    /** Runs are numbered. The test sets what starts and stops return. */
    private final class Scripted extends Lifecycle<Integer> {
        Supplier<Promise<@Nullable Void>> start = Promise::done;
        Supplier<Promise<@Nullable Void>> stop = Promise::done;
        boolean givesUp;
        private int runs;

        Promise<@Nullable Void> stop() {
            return endRun();
        }

        void failNow() {
            fail(new IllegalStateException("burnt out"));
        }

        @Override
        protected Throwable interrupted() {
            return new IllegalStateException("interrupted");
        }

        @Override
        protected Integer newRun() {
            return ++runs;
        }

        @Override
        protected Promise<@Nullable Void> startRun(Integer run) {
            calls.add("start " + run);
            return start.get();
        }

        @Override
        protected Promise<@Nullable Void> stopRun(Integer run) {
            calls.add("stop " + run);
            return stop.get();
        }

        @Override
        protected void startedLate(Integer run, @Nullable Throwable error) {
            calls.add("late " + run);
            stopAgain(run);
        }

        @Override
        protected void changed(State now, State before) {
            calls.add(before + " > " + now);
        }

        @Override
        protected Throwable failed(@Nullable Integer run, State during, Throwable why) {
            calls.add("failed while " + during);
            return why;
        }

        @Override
        protected void stopFailed(Throwable why) {
            calls.add("not stopped: " + why.getMessage());
        }

        @Override
        protected @Nullable Throwable blocked(Throwable whyUnstopped) {
            return givesUp ? null : new IllegalStateException("blocked by " + whyUnstopped.getMessage());
        }
    }

    private Promise<@Nullable Void> call(Supplier<Promise<@Nullable Void>> call) {
        var made = new ArrayList<Promise<@Nullable Void>>();
        test.run(() -> {
            made.add(call.get());
            made.getFirst().handle((done, error) -> null); // a test looks at it later, or not at all
        });
        return made.getFirst();
    }

    @Test
    void run_isStarted_andStopped() {
        assertThat(call(lifecycle::start).isDone()).isTrue();
        assertThat(call(lifecycle::start).isDone()).isTrue(); // it runs
        assertThat(call(lifecycle::stop).isDone()).isTrue();
        assertThat(call(lifecycle::stop).isDone()).isTrue(); // it has stopped
        assertThat(calls)
                .hasToString("[NOT_STARTED > STARTING, start 1, STARTING > RUNNING,"
                        + " RUNNING > STOPPING, stop 1, STOPPING > STOPPED]");
    }

    @Test
    void failedRun_isStopped_andTheNextBeginsAfterThat() {
        Deferred<@Nullable Void> slow = test.space().deferred();
        call(lifecycle::start);
        lifecycle.stop = () -> slow;
        test.run(lifecycle::failNow);
        assertThat(lifecycle.state()).isEqualTo(State.FAILED);
        calls.clear();
        var first = call(lifecycle::start);
        var second = call(lifecycle::start);
        assertThat(second).isSameAs(first);
        assertThat(calls).isEmpty();
        test.run(() -> slow.resolve(null));
        assertThat(first.isDone()).isTrue();
        assertThat(calls).containsExactly("FAILED > STARTING", "start 2", "STARTING > RUNNING");
    }

    @Test
    void runThatIsNotStopped_isStoppedAgain_andBlocksTheNext() {
        call(lifecycle::start);
        lifecycle.stop = () -> Promise.failed(new IllegalStateException("stuck"));
        assertThat(test.error(call(lifecycle::stop))).hasMessage("stuck");
        assertThat(test.error(call(lifecycle::start))).hasMessage("blocked by stuck");
        assertThat(calls).endsWith("failed while STOPPING", "STOPPING > FAILED", "stop 1", "not stopped: stuck");
        lifecycle.stop = Promise::done;
        assertThat(call(lifecycle::start).isDone()).isTrue();
        assertThat(calls).endsWith("stop 1", "FAILED > STARTING", "start 2", "STARTING > RUNNING");
    }

    @Test
    void runThatIsNotStopped_andIsGivenUp_doesNotBlockTheNext() {
        lifecycle.givesUp = true;
        call(lifecycle::start);
        lifecycle.stop = () -> Promise.failed(new IllegalStateException("stuck"));
        test.run(lifecycle::failNow);
        calls.clear();
        assertThat(call(lifecycle::start).isDone()).isTrue();
        assertThat(calls).containsExactly("FAILED > STARTING", "start 2", "STARTING > RUNNING");
    }

    @Test
    void stopDuringAStart_rejectsIt_andTheLateRunIsStoppedAgain() {
        Deferred<@Nullable Void> slow = test.space().deferred();
        lifecycle.start = () -> slow;
        var started = call(lifecycle::start);
        assertThat(call(lifecycle::stop).isDone()).isTrue();
        assertThat(test.error(started)).hasMessage("interrupted");
        calls.clear();
        test.run(() -> slow.resolve(null));
        assertThat(calls).containsExactly("late 1", "stop 1");
        assertThat(lifecycle.state()).isEqualTo(State.STOPPED);
    }
}
