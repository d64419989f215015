package io.troupe.actor.testkit;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;

import io.troupe.actor.Actor;
import io.troupe.actor.Deferred;
import io.troupe.actor.InTestSpace;
import io.troupe.actor.Promise;
import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.TimeoutException;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.Test;

class TestSpaceTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);

    static class Silent extends Actor {
        public void poke(String what) {
            throw new IllegalStateException(what);
        }

        public Promise<String> never() {
            return new Deferred<>();
        }
    }

    interface Quick {
        Promise<String> hi();
    }

    class Ticker extends Actor {
        private int ticks;

        @Override
        protected void started() {
            context().every(Duration.ofMillis(100), () -> ticks++);
        }

        public Promise<Integer> ticks() {
            return Promise.of(ticks);
        }
    }

    class Patient extends Actor {
        public Promise<String> ask() {
            return silent.never().orTimeout(Duration.ofSeconds(2));
        }

        public void wait(int millis, int times) {
            if (times > 0) {
                context().after(Duration.ofMillis(millis), () -> {
                    log.add("at " + context().space().clock().nanos() / 1_000_000 + " ms");
                    wait(millis, times - 1);
                });
            }
        }
    }

    private final Silent silent = test.spawn(Silent.class, Silent::new);

    @Test
    void timersOfActors_followTheManualClock() {
        Ticker ticker = test.spawn(Ticker.class, Ticker::new);
        test.advance(Duration.ofMillis(1_234));
        assertThat(test.get(ticker.ticks())).isEqualTo(12);
        test.space().stop(ticker);
        test.advance(Duration.ofMillis(1_234));
    }

    @Test
    void orTimeout_followsTheManualClock_andNamesTheRequest() {
        Promise<String> limited = silent.never().orTimeout(Duration.ofSeconds(3));
        test.advance(Duration.ofMillis(2_999));
        assertThat(limited.isDone()).isFalse();
        test.advance(Duration.ofMillis(1));
        assertThat(test.error(limited))
                .isInstanceOf(TimeoutException.class)
                .hasMessage("no answer to thread " + Thread.currentThread().getName()
                        + " within PT3S from Silent.never() of Silent#1, which has begun it");
    }

    @Test
    void orTimeout_ofAnAnswerThatComesFirst_isWithdrawn() {
        Quick quick = test.spawn(Quick.class, () -> () -> Promise.of("hi"));
        assertThat(test.get(quick.hi().orTimeout(SECOND))).isEqualTo("hi");
        test.advance(Duration.ofSeconds(2));
        assertThat(test.get(quick.hi())).isEqualTo("hi");
    }

    @Test
    void advance_servesWhatWaits_beforeItMovesTheClock() {
        Promise<String> limited = test.spawn(Patient.class, Patient::new).ask();
        test.advance(Duration.ofSeconds(3));
        assertThat(test.error(limited)).isInstanceOf(TimeoutException.class);
    }

    @Test
    void advance_goesFromTimerToTimer_soThatEachRunsAtItsOwnTime() {
        test.spawn(Patient.class, Patient::new).wait(1_000, 10);
        test.advance(Duration.ofMillis(3_500));
        assertThat(log).containsExactly("at 1000 ms", "at 2000 ms", "at 3000 ms");
        assertThat(test.clock().nanos()).isEqualTo(3_500_000_000L);
    }

    @Test
    void advance_backwards_isRejected() {
        assertThatThrownBy(() -> test.advance(Duration.ofSeconds(-1)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("PT-1S");
    }

    @Test
    void get_ofARejectedPromise_throwsItsError_whateverItIs() {
        for (var error : List.of(
                new TimeoutException("late"),
                new InterruptedException("woken"),
                new IOException("no disk"),
                new AssertionError("wrong"))) {
            assertThatThrownBy(() -> test.get(Promise.failed(error))).isSameAs(error);
        }
    }

    @Test
    void get_ofAPromiseThatWaitsForATimer_reportsIt() {
        Promise<?> delay = test.space().delay(SECOND);
        assertFails(() -> test.get(delay), "timers that wait for advance(..): 1");
        test.advance(SECOND);
        assertThat(delay.isDone()).isTrue();
    }

    // ---- what fails a test

    private static void assertFails(ThrowingCallable code, String part) {
        assertThatThrownBy(code).isInstanceOf(AssertionError.class).hasMessageContaining(part);
    }

    @Test
    void promiseThatNothingCanSettle_failsAtOnce() {
        assertFails(() -> test.get(silent.never()), "Silent.never() of Silent#1 is still pending");
    }

    @Test
    void forgottenProblem_failsTheTestAtTheEnd() {
        silent.poke("ouch");
        test.runQueued();
        assertFails(test::close, "Silent.poke(String) of Silent#1; if they are expected, takeProblems()");
        test.takeProblems();
    }

    /** Maven's reports lose a failure with an error that cannot be printed, and the test counts as passed. */
    @Test
    void forgottenProblem_thatCannotBePrinted_isPrintedAnotherWay() {
        var unprintable = new IllegalStateException() {
            private static final long serialVersionUID = 1L;

            @Override
            public String getMessage() {
                throw new UnsupportedOperationException();
            }
        };
        test.space().execute(() -> {
            throw unprintable;
        });
        test.runQueued();
        var failure = catchThrowable(test::close);
        test.takeProblems();
        assertThat(failure.getSuppressed())
                .singleElement()
                .satisfies(shown -> assertThat(shown.toString()).contains("UnsupportedOperationException"))
                .satisfies(shown -> assertThat(shown.getStackTrace()).isEqualTo(unprintable.getStackTrace()));
    }

    @Test
    void unservedMessage_failsTheTestAtTheEnd() {
        test.spawn(Patient.class, Patient::new).wait(1, 0); // does nothing
        assertFails(test::close, "messages waited");
    }
}
