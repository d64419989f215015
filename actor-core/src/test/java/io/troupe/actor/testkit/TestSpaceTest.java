package io.troupe.actor.testkit;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.concurrent.TimeoutException;
import org.junit.jupiter.api.Test;

class TestSpaceTest {
    interface Probe {
        void poke(String what);

        Promise<String> never();
    }

    private static final class Silent implements Probe {
        @Override
        public void poke(String what) {
            throw new IllegalStateException(what);
        }

        @Override
        public Promise<String> never() {
            return new Deferred<>();
        }
    }

    public static class Ticker extends Actor {
        private int ticks;

        @Override
        protected void started() {
            every(Duration.ofMillis(100), () -> ticks++);
        }

        public Promise<Integer> ticks() {
            return Promise.of(ticks);
        }
    }

    @Test
    void timersOfActors_followTheManualClock() {
        try (var test = new TestSpace()) {
            Ticker ticker = test.spawn(Ticker.class, Ticker::new);
            test.advance(Duration.ofMillis(1_234));
            assertThat(test.get(ticker.ticks())).isEqualTo(12);
            test.space().stop(ticker);
            test.advance(Duration.ofMillis(1_234));
        }
    }

    @Test
    void orTimeout_followsTheManualClock_andSaysWhatWasAsked() {
        try (var test = new TestSpace()) {
            Probe probe = test.spawn(Probe.class, Silent::new);
            Promise<String> limited = probe.never().orTimeout(Duration.ofSeconds(3));
            test.advance(Duration.ofMillis(2_999));
            assertThat(limited.isDone()).isFalse();
            test.advance(Duration.ofMillis(1));
            assertThat(test.error(limited))
                    .isInstanceOf(TimeoutException.class)
                    .hasMessage(
                            "no answer to thread main within PT3S from Probe.never() of Probe#1, which has begun it");
        }
    }

    @Test
    void orTimeout_ofAnAnswerThatComesFirst_isWithdrawn() {
        interface Quick {
            Promise<String> hi();
        }
        try (var test = new TestSpace()) {
            Quick quick = test.spawn(Quick.class, () -> () -> Promise.of("hi"));
            assertThat(test.get(quick.hi().orTimeout(Duration.ofSeconds(1)))).isEqualTo("hi");
            test.advance(Duration.ofSeconds(2));
            assertThat(test.get(quick.hi())).isEqualTo("hi");
        }
    }

    @Test
    void forgottenProblem_failsTheTestAtTheEnd() {
        var test = new TestSpace();
        test.spawn(Probe.class, Silent::new).poke("ouch");
        test.crank();
        assertThatThrownBy(test::close)
                .isInstanceOf(AssertionError.class)
                .hasMessageContaining("Probe.poke(String) of Probe#1");
    }

    @Test
    void unservedMessage_failsTheTestAtTheEnd() {
        var test = new TestSpace();
        var poked = new ArrayList<String>();
        interface Sink {
            void take(String what);
        }
        Sink sink = test.spawn(Sink.class, () -> poked::add);
        sink.take("waits");
        assertThatThrownBy(test::close).isInstanceOf(AssertionError.class).hasMessageContaining("messages waited");
    }

    @Test
    void promiseThatNothingCanSettle_failsAtOnce() {
        try (var test = new TestSpace()) {
            Probe probe = test.spawn(Probe.class, Silent::new);
            assertThatThrownBy(() -> test.get(probe.never()))
                    .isInstanceOf(AssertionError.class)
                    .hasMessageContaining("Probe.never() of Probe#1 is still pending");
        }
    }
}
