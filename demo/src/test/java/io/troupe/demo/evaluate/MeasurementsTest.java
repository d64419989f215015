package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

/** The averages of durations, and ratios, compared with values calculated by hand. */
class MeasurementsTest {
    @Test
    void trimmedMean_leavesOutTheLongestHundredth() {
        var durations = new Meter.Durations();
        for (int i = 0; i < 198; i++) {
            durations.add(i % 2 == 0 ? 1_000 : 3_000);
        }
        durations.add(1_000_000);
        durations.add(2_000_000);
        assertThat(durations.trimmedMean(1_000)).isEqualTo(2);
        assertThat(durations.quantile(0.5, 1_000)).isEqualTo(3);
    }

    @Test
    void trimmedMean_ofFew_isTheMeanOfAll() {
        var durations = new Meter.Durations();
        durations.add(1);
        durations.add(6);
        assertThat(durations.trimmedMean(1)).isEqualTo(3.5);
    }

    @Test
    void ratios_areOfTheSameRepetition() {
        assertThat(Measurements.ratios(new double[] {2, 9}, new double[] {1, 3}))
                .containsExactly(2, 3);
        assertThatThrownBy(() -> Measurements.ratios(new double[2], new double[1]))
                .hasMessage("2 numerators, expected 1 as there are denominators");
    }
}
