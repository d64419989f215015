package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

/** The statistics, compared with values calculated by hand. */
class SampleStatisticsTest {
    @Test
    void oneToFive_hasItsQuartilesAtTwoAndFour() {
        var spread = SampleStatistics.of(5, 1, 4, 2, 3);
        assertThat(spread).isEqualTo(new SampleStatistics(3, 2, 4, 1, 5, 5));
        assertThat(spread.halfWidth()).isEqualTo(1);
    }

    @Test
    void anEvenNumber_isHalvedBetweenTwo() {
        assertThat(SampleStatistics.of(1, 2, 3, 10)).isEqualTo(new SampleStatistics(2.5, 1.75, 4.75, 1, 10, 4));
    }

    @Test
    void oneValue_isAllThereIs() {
        assertThat(SampleStatistics.of(7)).isEqualTo(new SampleStatistics(7, 7, 7, 7, 7, 1));
    }

    @Test
    void text_leavesQuartilesOutThatNobodySees() {
        assertThat(SampleStatistics.of(1, 2, 3).text(1)).isEqualTo("2.0 (1.5..2.5)");
        assertThat(SampleStatistics.of(2.001, 2.002, 2.003).text(1)).isEqualTo("2.0");
    }

    @Test
    void nothing_andWhatIsNoNumber_areRefused() {
        assertThatThrownBy(SampleStatistics::of).hasMessage("0 values, expected at least one");
        assertThatThrownBy(() -> SampleStatistics.of(1, Double.NaN)).hasMessageContaining("a value is NaN");
    }

    @Test
    void trimmedMean_leavesOutTheLongestHundredth() {
        var durations = new Durations();
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
        var durations = new Durations();
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
