package io.troupe.common.measure;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.List;
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
    void twoValues_areInterpolated_alsoFromACollection() {
        assertThat(SampleStatistics.of(List.of(8.0, 4.0))).isEqualTo(new SampleStatistics(6, 5, 7, 4, 8, 2));
    }

    @Test
    void text_leavesQuartilesOutThatNobodySees() {
        assertThat(SampleStatistics.of(1, 2, 3).text(1)).isEqualTo("2.0 (1.5..2.5)");
        assertThat(SampleStatistics.of(2.001, 2.002, 2.003).text(1)).isEqualTo("2.0");
        assertThat(SampleStatistics.of(2, 2, 2).text(value -> "<" + value + ">"))
                .isEqualTo("<2.0> (<2.0>..<2.0>)");
    }

    @Test
    void nothing_andWhatIsNoNumber_areRefused() {
        assertThatThrownBy(() -> SampleStatistics.of()).hasMessage("0 values, expected at least one");
        assertThatThrownBy(() -> SampleStatistics.of(1, Double.NaN)).hasMessageContaining("a value is NaN");
    }
}
