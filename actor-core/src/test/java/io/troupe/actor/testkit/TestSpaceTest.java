package io.troupe.actor.testkit;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
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
    void orTimeout_followsTheManualClock_andNamesTheRequest() {
        try (var test = new TestSpace()) {
            Probe probe = test.spawn(Probe.class, Silent::new);
            Promise<String> limited = probe.never().orTimeout(Duration.ofSeconds(3));
            test.advance(Duration.ofMillis(2_999));
            assertThat(limited.isDone()).isFalse();
            test.advance(Duration.ofMillis(1));
            assertThat(test.error(limited))
                    .isInstanceOf(TimeoutException.class)
                    .hasMessage("no answer to thread " + Thread.currentThread().getName()
                            + " within PT3S from Probe.never() of Probe#1, which has begun it");
        }
    }

    public static class Patient extends Actor {
        private final Probe probe;
        private final List<String> log;

        Patient(Probe probe, List<String> log) {
            this.probe = probe;
            this.log = log;
        }

        public Promise<String> ask() {
            return probe.never().orTimeout(Duration.ofSeconds(2));
        }

        public void wait(int millis, int times) {
            if (times > 0) {
                after(Duration.ofMillis(millis), () -> {
                    log.add("at " + space().clock().nanos() / 1_000_000 + " ms");
                    wait(millis, times - 1);
                });
            }
        }
    }

    @Test
    void advance_servesWhatWaits_beforeItMovesTheClock() {
        try (var test = new TestSpace()) {
            Probe probe = test.spawn(Probe.class, Silent::new);
            Patient patient = test.spawn(Patient.class, () -> new Patient(probe, new ArrayList<>()));
            Promise<String> limited = patient.ask();
            test.advance(Duration.ofSeconds(3));
            assertThat(test.error(limited)).isInstanceOf(TimeoutException.class);
        }
    }

    @Test
    void advance_goesFromTimerToTimer_soThatEachRunsAtItsOwnTime() {
        var log = new ArrayList<String>();
        try (var test = new TestSpace()) {
            Probe probe = test.spawn(Probe.class, Silent::new);
            Patient patient = test.spawn(Patient.class, () -> new Patient(probe, log));
            patient.wait(1_000, 10);
            test.advance(Duration.ofMillis(3_500));
            assertThat(log).containsExactly("at 1000 ms", "at 2000 ms", "at 3000 ms");
            assertThat(test.clock().nanos()).isEqualTo(3_500_000_000L);
        }
    }

    @Test
    void advance_backwards_isRejected() {
        try (var test = new TestSpace()) {
            assertThatThrownBy(() -> test.advance(Duration.ofSeconds(-1)))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessageContaining("PT-1S");
        }
    }

    @Test
    void get_ofARejectedPromise_throwsItsError_whateverItIs() {
        try (var test = new TestSpace()) {
            for (var error : List.of(
                    new TimeoutException("late"),
                    new InterruptedException("woken"),
                    new IOException("no disk"),
                    new AssertionError("wrong"))) {
                assertThatThrownBy(() -> test.get(Promise.failed(error))).isSameAs(error);
            }
        }
    }

    @Test
    void get_ofAPromiseThatWaitsForATimer_reportsIt() {
        try (var test = new TestSpace()) {
            Promise<?> delay = test.space().delay(Duration.ofSeconds(1));
            assertThatThrownBy(() -> test.get(delay))
                    .isInstanceOf(AssertionError.class)
                    .hasMessageContaining("timers that wait for advance(..): 1");
            test.advance(Duration.ofSeconds(1));
            assertThat(delay.isDone()).isTrue();
        }
    }

    @Test
    void spawn_takesSettings() {
        try (var test = new TestSpace()) {
            Probe probe = test.spawn(Probe.class, Silent::new, ActorSettings.named("silent"));
            assertThat(probe).hasToString("silent");
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
