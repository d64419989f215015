package io.troupe.demo.evaluate;

import static io.troupe.demo.evaluate.ClaimVerdict.CANNOT_BE_TOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.DOES_NOT_HOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.HOLDS;
import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;

/** The rules that decide a claim. */
class ClaimVerdictTest {
    private static double[] numbers(double... numbers) {
        return numbers;
    }

    @Test
    void above_isDecidedByTheQuartiles() {
        assertThat(ClaimVerdict.above(numbers(1.1, 1.2, 1.3, 1.4, 0.9), 1)).isEqualTo(HOLDS);
        assertThat(ClaimVerdict.above(numbers(0.8, 0.85, 0.9, 0.95, 1.1), 1)).isEqualTo(DOES_NOT_HOLD);
        assertThat(ClaimVerdict.above(numbers(0.8, 0.9, 1.05, 1.1, 1.2), 1)).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void above_ofWhatIsExactlyTheSame_isNo() {
        assertThat(ClaimVerdict.above(numbers(1), 1)).isEqualTo(DOES_NOT_HOLD);
        assertThat(ClaimVerdict.above(numbers(1, 1, 1), 1)).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void above_ofOneMeasurement_needsAPlainDifference() {
        assertThat(ClaimVerdict.above(numbers(1.05), 1)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(ClaimVerdict.above(numbers(0.95), 1)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(ClaimVerdict.above(numbers(2), 1)).isEqualTo(HOLDS);
        assertThat(ClaimVerdict.above(numbers(0.5), 1)).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void within_isDecidedByTheQuartiles() {
        assertThat(ClaimVerdict.within(numbers(1, 1.2, 1.5, 1.7, 2), 1, 2)).isEqualTo(HOLDS);
        assertThat(ClaimVerdict.within(numbers(2, 2.1, 4, 5, 6), 1, 2)).isEqualTo(DOES_NOT_HOLD);
        assertThat(ClaimVerdict.within(numbers(0.1, 0.2, 0.3, 0.4, 1), 1, 2)).isEqualTo(DOES_NOT_HOLD);
        assertThat(ClaimVerdict.within(numbers(1, 2, 5), 1, 2)).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void within_ofOneMeasurement_needsAPlainDifferenceToSayNo() {
        assertThat(ClaimVerdict.within(numbers(2.1), 1, 2)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(ClaimVerdict.within(numbers(2.3), 1, 2)).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void numbersThatAreNeverTwiceTheSame_tellNothingOnce() {
        assertThat(HOLDS.ifRepeated(4)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(HOLDS.ifRepeated(5)).isEqualTo(HOLDS);
    }

    @Test
    void agreed_isWhatAllFind() {
        assertThat(ClaimVerdict.agreed(List.of(HOLDS, HOLDS))).isEqualTo(HOLDS);
        assertThat(ClaimVerdict.agreed(List.of(HOLDS, DOES_NOT_HOLD))).isEqualTo(CANNOT_BE_TOLD);
    }
}
