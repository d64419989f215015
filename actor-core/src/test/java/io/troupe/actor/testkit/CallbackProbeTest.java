package io.troupe.actor.testkit;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Callback;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class CallbackProbeTest {
    interface Counter {
        void count(int from, int to, @Nullable String error, Callback<Integer> numbers);
    }

    static final class Counting implements Counter {
        @Override
        public void count(int from, int to, @Nullable String error, Callback<Integer> numbers) {
            for (int number = from; number <= to && !numbers.isCancelled(); number++) {
                numbers.next(number);
            }
            if (error == null) {
                numbers.finish();
            } else {
                numbers.fail(new IllegalStateException(error));
            }
        }
    }

    private final TestSpace test = new TestSpace();
    private final Counter counter = test.spawn(Counter.class, Counting::new);
    private final CallbackProbe<Integer> numbers = test.callback();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void resultsAndSuccess_areRecorded() {
        numbers.expectOpen();
        counter.count(1, 3, null, numbers);
        assertThat(numbers.results()).containsExactly(1, 2, 3);
        numbers.expectFinished();
    }

    @Test
    void resultsAndFailure_areRecorded() {
        counter.count(1, 1, "tired", numbers);
        assertThat(numbers.expectFailed()).hasMessage("tired");
        assertThat(numbers.results()).containsExactly(1);
    }

    @Test
    void cancelledProbe_isSeenByTheSender_andReceivesNothing() {
        numbers.cancel();
        counter.count(1, 3, null, numbers);
        assertThat(numbers.results()).isEmpty();
        numbers.expectOpen();
    }

    @Test
    void otherEnd_isReportedWithTheResultsSoFar() {
        assertThatThrownBy(numbers::expectFinished)
                .isInstanceOf(AssertionError.class)
                .hasMessage("callback: expected finish(), but no end came; results so far: []");
        counter.count(1, 2, null, numbers);
        assertThatThrownBy(numbers::expectFailed)
                .isInstanceOf(AssertionError.class)
                .hasMessage("callback: expected fail(..), but finish() came; results so far: [1, 2]");
        assertThatThrownBy(numbers::expectOpen)
                .isInstanceOf(AssertionError.class)
                .hasMessage("callback: expected no end, but finish() came; results so far: [1, 2]");
        CallbackProbe<Integer> failed = test.callback();
        counter.count(1, 1, "tired", failed);
        assertThatThrownBy(failed::expectFinished)
                .isInstanceOf(AssertionError.class)
                .hasMessage("callback: expected finish(), but fail(java.lang.IllegalStateException: tired) came;"
                        + " results so far: [1]");
    }

    @Test
    void senderThatGoesOnAfterTheEnd_isRejected() {
        numbers.next(1);
        numbers.finish();
        assertThatThrownBy(() -> numbers.next(2))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("next(2) came after the end, finish()");
        assertThatThrownBy(numbers::finish)
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("finish() came after the end, finish()");
        assertThatThrownBy(() -> numbers.fail(new IllegalStateException("no")))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("fail(java.lang.IllegalStateException: no) came after the end, finish()");
        assertThat(numbers.results()).containsExactly(1);
    }
}
