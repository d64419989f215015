package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.State;
import org.junit.jupiter.api.Test;

/**
 * Loops with a manual robots' clock, where computing takes no time and each command takes effect for 100 ms; averages
 * of durations, and ratios, compared with values calculated by hand.
 */
class MeterTest {
    private static final int FOLLOWER = 0;
    private static final int WANDERER = 1;
    private static final State STATE = JobRunner.oneState().first();

    private long millis;

    private final Meter.RobotClock time = new Meter.RobotClock() {
        @Override
        public long nanos() {
            return millis * 1_000_000;
        }

        @Override
        public long endOfCycleNanos() {
            return (millis + 100) * 1_000_000;
        }
    };

    /** Creates the meter at 0 s; the first robot connects after 5 s, the second after 7 s. */
    private LoopMeter connected(Mode mode, int loops) {
        var meter = new LoopMeter(mode, STATE, loops, time);
        millis = 5000;
        meter.serviceStarted(FOLLOWER, STATE.services().get(FOLLOWER));
        millis = 7000;
        meter.serviceStarted(WANDERER, STATE.services().get(WANDERER));
        return meter;
    }

    private void cycles(LoopMeter meter, int robot, long... atMillis) {
        for (long at : atMillis) {
            millis = at;
            meter.cycleStarted(robot, STATE.services().get(robot));
            meter.cycleEnded(robot, STATE.services().get(robot));
        }
    }

    private static double value(LoopMeter meter, String subject, Quantity quantity) {
        return meter.result().values().stream()
                .filter(each -> each.subject().equals(subject) && each.quantity() == quantity)
                .mapToDouble(Job.Result.Value::value)
                .sum();
    }

    private static void assertTimesMs(LoopMeter meter, double follower, double wanderer, double both) {
        assertThat(value(meter, Measurement.FOLLOWER, Quantity.TIME)).isEqualTo(follower);
        assertThat(value(meter, Measurement.WANDERER, Quantity.TIME)).isEqualTo(wanderer);
        assertThat(value(meter, Measurement.BOTH, Quantity.TIME)).isEqualTo(both);
    }

    private static double intervalMs(LoopMeter meter, int robot) {
        return value(meter, STATE.services().get(robot).name(), Quantity.INTERVAL);
    }

    @Test
    void connecting_isNotCounted_butWaitingForTheFirstReadingIs() {
        LoopMeter meter = connected(Mode.PROMISE, 3);
        for (long at : new long[] {7030, 7130, 7230}) {
            cycles(meter, FOLLOWER, at);
            cycles(meter, WANDERER, at);
        }
        assertTimesMs(meter, 330, 330, 330); // from 7 s to 7.33 s
    }

    @Test
    void servicesInTurn_shareTheTime_eachFromTheEndOfTheOthersLoop() {
        LoopMeter meter = connected(Mode.SYNC, 3);
        for (long at : new long[] {7030, 7230, 7430}) {
            cycles(meter, FOLLOWER, at);
            cycles(meter, WANDERER, at + 100);
        }
        assertTimesMs(meter, 330, 300, 630); // the sum, as in the paper
        assertThat(intervalMs(meter, FOLLOWER)).isEqualTo(200);
        assertThat(intervalMs(meter, WANDERER)).isEqualTo(200);
    }

    @Test
    void interval_isThatOfOneServicesCycles_withTheMiddleAndTheLongest() {
        LoopMeter meter = connected(Mode.CALLBACK, 4);
        cycles(meter, FOLLOWER, 7000, 7100, 7200, 7500);
        cycles(meter, WANDERER, 7500, 7550, 7600, 7650);
        assertThat(intervalMs(meter, FOLLOWER)).isEqualTo(100);
        // of 100, 100 and 300 ms, interpolated between the two longest
        assertThat(value(meter, "wallFollower", Quantity.INTERVAL_P99)).isCloseTo(296, within(1e-9));
        assertThat(intervalMs(meter, WANDERER)).isEqualTo(50);
    }

    @Test
    void measurement_isDoneWhenBothServicesAre_andFurtherLoopsOfTheFasterOneAreNotCounted() {
        LoopMeter meter = connected(Mode.PROMISE, 2);
        cycles(meter, FOLLOWER, 7000, 7100, 7900, 8000);
        assertThat(meter.isDone()).isFalse();
        cycles(meter, WANDERER, 8000);
        assertThat(meter.isDone()).isFalse();
        cycles(meter, WANDERER, 8100);
        assertThat(meter.isDone()).isTrue();
        cycles(meter, WANDERER, 9000);
        assertTimesMs(meter, 200, 1200, 1200);
        assertThat(intervalMs(meter, FOLLOWER)).isEqualTo(100);
    }

    @Test
    void trimmedMean_leavesOutTheLongestHundredth_ofFewNothing() {
        var many = new Meter.Durations();
        for (int i = 0; i < 198; i++) {
            many.add(i % 2 == 0 ? 1_000 : 3_000);
        }
        many.add(1_000_000);
        many.add(2_000_000);
        assertThat(many.trimmedMean(1_000)).isEqualTo(2);
        assertThat(many.quantile(0.5, 1_000)).isEqualTo(3);
        var few = new Meter.Durations();
        few.add(1);
        few.add(6);
        assertThat(few.trimmedMean(1)).isEqualTo(3.5);
    }

    @Test
    void ratios_areOfTheSameRepetition() {
        assertThat(Measurements.ratios(new double[] {2, 9}, new double[] {1, 3}))
                .containsExactly(2, 3);
        assertThatThrownBy(() -> Measurements.ratios(new double[2], new double[1]))
                .hasMessage("2 numerators, expected 1 as there are denominators");
    }
}
