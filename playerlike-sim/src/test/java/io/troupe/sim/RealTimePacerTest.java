package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.time.ManualClock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Runs on a clock that moves only during sleeps and work. */
class RealTimePacerTest {
    private static final double NEVER = Double.POSITIVE_INFINITY;

    private final ManualClock wall = new ManualClock();
    private final List<Long> sleptMillis = new ArrayList<>();
    private final RealTimePacer pacer = new RealTimePacer(wall, nanos -> {
        sleptMillis.add(nanos / 1_000_000);
        wall.advance(Duration.ofNanos(nanos));
    });
    private long micros;

    private void tick(double factor, int workMillis) {
        wall.advance(Duration.ofMillis(workMillis));
        pacer.await(micros, micros + 100_000, factor);
        micros += 100_000;
    }

    @Test
    void realTime_sleepsForWhatTheWorkHasLeftOver() {
        tick(1, 0);
        tick(1, 30);
        tick(1, 99);
        assertThat(sleptMillis).containsExactly(100L, 70L, 1L);
    }

    @Test
    void factor_dividesTheInterval() {
        tick(4, 0);
        tick(4, 5);
        tick(0.5, 0);
        assertThat(sleptMillis).containsExactly(25L, 20L, 200L);
    }

    @Test
    void smallDelay_isCaughtUp() {
        tick(1, 0);
        tick(1, 300); // 0.2 s late
        tick(1, 0);
        tick(1, 0);
        assertThat(sleptMillis).as("the fourth deadline is where it was").containsExactly(100L);
        tick(1, 0);
        assertThat(sleptMillis).containsExactly(100L, 100L);
        assertThat(wall.nanos()).isEqualTo(500_000_000);
        assertThat(pacer.droppedMicros()).isZero();
    }

    @Test
    void largeDelay_isDropped_exceptForAQuarterOfASecond() {
        tick(1, 0);
        tick(1, 2100); // 2 s late
        assertThat(pacer.droppedMicros()).isEqualTo(1_750_000);
        tick(1, 0);
        tick(1, 0);
        assertThat(sleptMillis).containsExactly(100L);
        tick(1, 0);
        assertThat(sleptMillis).as("it caught up with 250 ms in 300").containsExactly(100L, 50L);
    }

    @Test
    void largeDelay_atAnotherPace_isCountedInSimulatedTime() {
        tick(2, 0);
        tick(2, 1050); // a second on the wall clock, two simulated ones
        assertThat(pacer.droppedMicros()).isEqualTo(1_750_000);
    }

    @Test
    void unlimited_neverSleeps_andOwesNothingAfterwards() {
        tick(1, 0);
        tick(NEVER, 0);
        tick(NEVER, 5000);
        tick(1, 0);
        assertThat(sleptMillis).containsExactly(100L, 100L);
        assertThat(pacer.droppedMicros()).isZero();
    }

    @Test
    void restart_forgetsThatTimeStoodStill() {
        tick(1, 0);
        pacer.restart();
        tick(1, 60_000);
        assertThat(sleptMillis).containsExactly(100L, 100L);
        assertThat(pacer.droppedMicros()).isZero();
    }

    @Test
    void pace_knowsWhoWaitsForWhom() {
        assertThat(new Pace.OfAnswers().factor(false)).isEqualTo(NEVER);
        assertThat(new Pace.OfAnswers().factor(true)).isEqualTo(1);
        assertThat(new Pace.RealTime(3).factor(false)).isEqualTo(3);
        assertThat(new Pace.Unlimited().factor(true)).isEqualTo(NEVER);
        assertThatThrownBy(() -> new Pace.RealTime(0)).hasMessage("pace is 0.0 times real time, expected more than 0");
    }

    @Test
    void pace_nextToNothing_waitsVeryLong_andIsNeverLate() {
        var left = new ArrayList<Long>();
        var slow = new RealTimePacer(wall, nanos -> {
            left.add(nanos);
            wall.advance(Duration.ofNanos(nanos));
        });
        slow.await(0, 100_000, 1e-15);
        assertThat(left).as("nanoseconds").containsExactly(1L << 61);
        slow.await(100_000, 200_000, Double.MIN_VALUE);
        assertThat(left).as("nanoseconds").hasSize(2);
        assertThat(slow.droppedMicros()).isZero();
    }
}
