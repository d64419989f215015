package io.troupe.bench.builds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.bench.builds.BuildVerdict.Interval;
import io.troupe.bench.builds.BuildVerdict.Kind;
import io.troupe.bench.builds.BuildVerdict.Round;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import java.util.function.ToDoubleFunction;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

class BuildVerdictTest {
    private static final int ROWS = 10_000;

    /** The confidence of the interval from the r-th lowest to the r-th highest of n values, by the binomial formula. */
    @ParameterizedTest
    @CsvSource({"1,1,0", "2,1,0.5", "3,1,0.75", "4,1,0.875", "5,1,0.9375", "8,2,0.9296875", "10,2,0.978515625"})
    void interval_ofAMedian_hasTheClosedFormConfidence(int count, int rank, double confidence) {
        assertThat(Interval.rank(count)).isEqualTo(rank);
        assertThat(Interval.confidence(count, rank)).isCloseTo(confidence, within(1e-12));
    }

    @Test
    void starts_giveMediansOfTheirRounds_andTheIntervalOfThese() {
        List<List<Round<Double>>> starts = new ArrayList<>();
        for (double factor : List.of(1.5, 1.2, 1.1, 1.3, 1.4, 9.0, 0.1, 1.25)) {
            // the second round is disturbed, and the medians are not
            starts.add(List.of(
                    new Round<>(10.0, 10 * factor, 10 * factor),
                    new Round<>(10.0, 1_000.0, 900.0),
                    new Round<>(20.0, 20 * factor / 1.01, 20 * factor * 1.01)));
        }
        BuildVerdict verdict = BuildVerdict.of(starts, each -> each);
        assertThat(verdict.change().low()).isCloseTo(1.1, within(1e-9)); // the second of eight
        assertThat(verdict.change().high()).isCloseTo(1.5, within(1e-9));
        assertThat(verdict.change().median()).isCloseTo(Math.sqrt(1.25 * 1.3), within(1e-9));
        assertThat(verdict.itself().median()).isCloseTo(1, within(1e-9));
        assertThat(verdict.noise()).isEqualTo(BuildVerdict.LEAST_NOISE);
        assertThat(verdict.kind()).isEqualTo(Kind.MORE);
    }

    @Test
    void change_withinTheNoise_isNoDifference_andBeyondItIsOne() {
        assertThat(verdict(4, 1.09, 1.1).kind()).isEqualTo(Kind.NO_DIFFERENCE);
        assertThat(verdict(4, 1.2, 1.1).kind()).isEqualTo(Kind.MORE);
        assertThat(verdict(4, 1 / 1.2, 1.1).kind()).isEqualTo(Kind.LESS);
        assertThat(verdict(4, 1 / 1.09, 1 / 1.1).kind()).isEqualTo(Kind.NO_DIFFERENCE);
        assertThat(verdict(4, 1.015, 1).kind()).isEqualTo(Kind.NO_DIFFERENCE);
        assertThat(verdict(4, 1.2, 1.1).noise()).isCloseTo(0.1, within(1e-9));
        assertThat(verdict(2, 9, 1).kind()).isEqualTo(Kind.TOO_FEW_STARTS);
    }

    private static BuildVerdict verdict(int starts, double change, double itself) {
        var round = new Round<>(7.0, 7 * change * Math.sqrt(itself), 7 * change / Math.sqrt(itself));
        return BuildVerdict.of(Collections.nCopies(starts, List.of(round)), each -> each);
    }

    /** Draws the logarithm of the speed of a JVM. */
    private interface Speeds extends ToDoubleFunction<Random> {}

    private static final Speeds NORMAL = random -> 0.05 * random.nextGaussian();
    /** Compiled in one of two ways. */
    private static final Speeds TWO_SPEEDS =
            random -> (random.nextInt(3) == 0 ? 0.5 : 0) + 0.01 * random.nextGaussian();
    /** Often disturbed, sometimes by a lot. */
    private static final Speeds HEAVY = random -> 0.02 * random.nextGaussian() / Math.max(1e-3, random.nextDouble());

    private static double share(Kind kind, int starts, double change, Speeds speeds) {
        var random = new Random(7);
        int found = 0;
        for (int row = 0; row < ROWS; row++) {
            List<List<Round<Double>>> all = new ArrayList<>();
            for (int start = 0; start < starts; start++) {
                all.add(List.of(new Round<>(
                        Math.exp(speeds.applyAsDouble(random)),
                        change * Math.exp(speeds.applyAsDouble(random)),
                        change * Math.exp(speeds.applyAsDouble(random)))));
            }
            found += BuildVerdict.of(all, each -> each).kind() == kind ? 1 : 0;
        }
        return (double) found / ROWS;
    }

    @ParameterizedTest
    @ValueSource(ints = {3, 4, 5, 6, 7})
    void equalBuilds_areCalledSlower_atMostInTheShareThatHoldsForEveryDistribution(int starts) {
        for (Speeds speeds : List.of(NORMAL, TWO_SPEEDS, HEAVY)) {
            assertThat(share(Kind.MORE, starts, 1, speeds)).isLessThanOrEqualTo(Math.pow(3, -starts));
            assertThat(share(Kind.LESS, starts, 1, speeds)).isLessThanOrEqualTo(Math.pow(3, -starts));
        }
    }

    @Test
    void equalBuilds_withEightStarts_areCalledSlowerInFewerThanOneOfAThousandRows() {
        for (Speeds speeds : List.of(NORMAL, TWO_SPEEDS, HEAVY)) {
            assertThat(share(Kind.MORE, 8, 1, speeds)).isLessThan(0.001);
            assertThat(share(Kind.LESS, 8, 1, speeds)).isLessThan(0.001);
        }
    }

    @Test
    void build_thatIsTwentyPercentSlower_isFound() {
        Speeds quiet = random -> 0.02 * random.nextGaussian();
        assertThat(share(Kind.MORE, 4, 1.2, quiet)).isGreaterThan(0.99);
        assertThat(share(Kind.MORE, 8, 1.2, quiet)).isGreaterThan(0.999);
        assertThat(share(Kind.LESS, 8, 1 / 1.2, quiet)).isGreaterThan(0.999);
        assertThat(share(Kind.MORE, 8, 1.2, NORMAL)).isGreaterThan(0.8);
    }
}
