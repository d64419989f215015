package io.troupe.services.behaviour;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import org.junit.jupiter.api.Test;

class ReadingTimeTest {
    private final ReadingTime time = new ReadingTime();

    @Test
    void clockThatIsNotSetBack_isTheTimeItself_bitForBit() {
        for (double stamp : new double[] {-3.1, 0, 0.1, 0.30000000000000004, 1.7e9, 1.7e9 + 60}) {
            assertThat(time.at(stamp)).isEqualTo(stamp);
            assertThat(time.at(stamp)).as("asked again").isEqualTo(stamp);
        }
    }

    @Test
    void clockThatIsSetBack_goesOnByACycle_eachTime() {
        time.at(100);
        assertThat(time.at(40)).isCloseTo(100.1, within(1e-9));
        assertThat(time.at(40)).isCloseTo(100.1, within(1e-9));
        assertThat(time.at(40.1)).isCloseTo(100.2, within(1e-9));
        assertThat(time.at(-20)).isCloseTo(100.3, within(1e-9));
        assertThat(time.at(40)).as("a minute forward").isCloseTo(160.3, within(1e-9));
    }

    @Test
    void stampsThatJitter_areTheSameTime_andNoCycle() {
        double seconds = time.at(100);
        for (int i = 0; i < 1000; i++) {
            assertThat(time.at(99.999)).isEqualTo(seconds);
            assertThat(time.at(100)).isEqualTo(seconds);
        }
        assertThat(time.at(99.95)).isEqualTo(seconds);
        assertThat(time.at(100.05)).as("no cycle was added").isEqualTo(100.05);
        assertThat(time.at(100.02)).isEqualTo(100.05);
        assertThat(time.at(99.9))
                .as("set back by more than a cycle, in two steps")
                .isCloseTo(100.15, within(1e-9));
    }

    @Test
    void cycle_isAHundredMilliseconds_orAStepOfTheClock() {
        assertThat(ReadingTime.isCycle(Double.NEGATIVE_INFINITY, 0)).isTrue();
        assertThat(ReadingTime.isCycle(1, 1.0996)).isTrue();
        assertThat(ReadingTime.isCycle(1, 1.05)).isFalse();
        assertThat(ReadingTime.isCycle(1, 1)).isFalse();
        assertThat(ReadingTime.isCycle(100, 40)).isTrue();
    }
}
