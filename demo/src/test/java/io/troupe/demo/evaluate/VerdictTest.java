package io.troupe.demo.evaluate;

import static io.troupe.demo.evaluate.Verdict.CANNOT_BE_TOLD;
import static io.troupe.demo.evaluate.Verdict.DOES_NOT_HOLD;
import static io.troupe.demo.evaluate.Verdict.HOLDS;
import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;

/** The rules that decide a claim. */
class VerdictTest {
    private static double[] numbers(double... numbers) {
        return numbers;
    }

    @Test
    void above_isDecidedByTheQuartiles() {
        assertThat(Verdict.above(numbers(1.1, 1.2, 1.3, 1.4, 0.9), 1)).isEqualTo(HOLDS);
        assertThat(Verdict.above(numbers(0.8, 0.85, 0.9, 0.95, 1.1), 1)).isEqualTo(DOES_NOT_HOLD);
        assertThat(Verdict.above(numbers(0.8, 0.9, 1.05, 1.1, 1.2), 1)).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void above_ofWhatIsExactlyTheSame_isNo() {
        assertThat(Verdict.above(numbers(1), 1)).isEqualTo(DOES_NOT_HOLD);
        assertThat(Verdict.above(numbers(1, 1, 1), 1)).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void above_ofOneMeasurement_needsAPlainDifference() {
        assertThat(Verdict.above(numbers(1.05), 1)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(Verdict.above(numbers(0.95), 1)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(Verdict.above(numbers(2), 1)).isEqualTo(HOLDS);
        assertThat(Verdict.above(numbers(0.5), 1)).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void within_isDecidedByTheQuartiles() {
        assertThat(Verdict.within(numbers(1, 1.2, 1.5, 1.7, 2), 1, 2)).isEqualTo(HOLDS);
        assertThat(Verdict.within(numbers(2, 2.1, 4, 5, 6), 1, 2)).isEqualTo(DOES_NOT_HOLD);
        assertThat(Verdict.within(numbers(0.1, 0.2, 0.3, 0.4, 1), 1, 2)).isEqualTo(DOES_NOT_HOLD);
        assertThat(Verdict.within(numbers(1, 2, 5), 1, 2)).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void within_ofOneMeasurement_needsAPlainDifferenceToSayNo() {
        assertThat(Verdict.within(numbers(2.1), 1, 2)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(Verdict.within(numbers(2.3), 1, 2)).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void numbersThatAreNeverTwiceTheSame_tellNothingOnce() {
        assertThat(HOLDS.ifRepeated(4)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(HOLDS.ifRepeated(5)).isEqualTo(HOLDS);
    }

    @Test
    void agreed_isWhatAllFind() {
        assertThat(Verdict.agreed(List.of(HOLDS, HOLDS))).isEqualTo(HOLDS);
        assertThat(Verdict.agreed(List.of(HOLDS, DOES_NOT_HOLD))).isEqualTo(CANNOT_BE_TOLD);
    }
}
