package io.troupe.actor.guide;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.actor.time.Schedule;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * The sections "An interface and an object" on the global space, "Or a class", "Timers", and the first sample of
 * "Testing".
 */
class ActorsGuideTest {
    private final Deferred<String> shown = new Deferred<>();

    private void show(Object what) {
        shown.resolve(what + " on " + Thread.currentThread().getName());
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void thermostat_takesMessages_andAnswersRequests() throws Exception {
        Heating.Thermostat heater = ActorSpace.global().spawn(Heating.Thermostat.class, Heating.Heater::new);
        heater.set(21.5);
        heater.read().then(degrees -> show(degrees));
        assertThat(shown.get(Duration.ofSeconds(30))).isEqualTo("21.5 on actor-space");
        ActorSpace.global().stop(heater);
    }

    static class Blinker extends Actor {
        private boolean on;

        @Override
        protected void started() {
            every(Duration.ofMillis(500), () -> on = !on);
        }

        public Promise<Boolean> isOn() {
            return Promise.of(on);
        }

        public Promise<Boolean> isOnLater() {
            return ((Blinker) self()).isOn(); // a message to itself, not a call
        }
    }

    @Test
    void blinker_blinks_byTheManualClock() {
        try (var test = new TestSpace()) { // no thread, and a manual clock
            Blinker blinker = test.spawn(Blinker.class, Blinker::new);
            test.advance(Duration.ofMillis(1_200));
            assertThat(test.get(blinker.isOn())).isFalse(); // on at 500 ms, off at 1000 ms
        }
    }

    @Test
    void messageToItself_isNoCall_andAnswersAsOne() {
        try (var test = new TestSpace()) {
            Blinker blinker = test.spawn(Blinker.class, Blinker::new);
            Promise<Boolean> later = blinker.isOnLater();
            long before = test.space().metrics().served();
            assertThat(test.get(later)).isFalse();
            assertThat(test.space().metrics().served() - before).isGreaterThanOrEqualTo(2); // itself, and what it sent
        }
    }

    static class Listener extends Actor {
        private final List<String> log;

        Listener(List<String> log) {
            this.log = log;
        }

        public void heard() {
            after("silence", Duration.ofSeconds(3), this::stopMotors); // three seconds after the last word
        }

        public void rest() {
            cancelTimer("silence");
        }

        private void stopMotors() {
            log.add("stopped at " + space().clock().nanos() / 1_000_000_000);
        }
    }

    @Test
    void timerWithAKey_beginsAnew_andCanBeTakenBack() {
        var log = new ArrayList<String>();
        try (var test = new TestSpace()) {
            Listener listener = test.spawn(Listener.class, () -> new Listener(log));
            listener.heard();
            test.crank();
            test.advance(Duration.ofSeconds(2));
            listener.heard();
            test.crank();
            test.advance(Duration.ofSeconds(2));
            assertThat(log).isEmpty();
            test.advance(Duration.ofSeconds(1));
            assertThat(log).containsExactly("stopped at 5");
            listener.heard();
            listener.rest();
            test.advance(Duration.ofSeconds(9));
            assertThat(log).hasSize(1);
        }
    }

    static class Loops extends Actor {
        private final List<String> log;

        Loops(List<String> log) {
            this.log = log;
        }

        @Override
        protected void started() {
            every(
                    Duration.ofMillis(10),
                    this::count); // Schedule.FIXED_RATE: catches up on missed runs of the last second
            every(Duration.ofMillis(10), Schedule.SKIP_MISSED, this::control); // drops missed runs: for control loops
            every(
                    "poll",
                    Duration.ofSeconds(1),
                    Schedule.FIXED_DELAY,
                    this::poll); // one second after the end of the last run
        }

        private void count() {
            log.add("count");
        }

        private void control() {
            log.add("control");
        }

        private void poll() {
            log.add("poll");
        }
    }

    @Test
    void periodicTimer_thatIsLate_goesByItsSchedule() {
        var log = new ArrayList<String>();
        try (var test = new TestSpace()) {
            test.spawn(Loops.class, () -> new Loops(log));
            test.crank();
            test.clock().advance(Duration.ofMillis(1_500)); // in one step, as after a stall
            test.crank();
            assertThat(log).hasSize(150 + 1 + 1);
            assertThat(log).filteredOn("count"::equals).hasSize(150);
            test.advance(Duration.ofMillis(999));
            assertThat(log).filteredOn("poll"::equals).hasSize(1);
            test.advance(Duration.ofMillis(1));
            assertThat(log).filteredOn("poll"::equals).hasSize(2);
        }
    }
}
