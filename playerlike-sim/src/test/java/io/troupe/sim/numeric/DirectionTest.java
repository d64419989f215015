package io.troupe.sim.numeric;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Random;
import org.junit.jupiter.api.Test;

class DirectionTest {
    private final Direction direction = new Direction();

    private void assertSameAsStrictMath(double angleRad) {
        direction.set(angleRad);
        if (Double.doubleToRawLongBits(direction.cos()) != Double.doubleToRawLongBits(StrictMath.cos(angleRad))
                || Double.doubleToRawLongBits(direction.sin())
                        != Double.doubleToRawLongBits(StrictMath.sin(angleRad))) {
            assertThat(new double[] {direction.cos(), direction.sin()})
                    .as("of %s", angleRad)
                    .containsExactly(StrictMath.cos(angleRad), StrictMath.sin(angleRad));
        }
    }

    @Test
    void angles_atRandom_haveTheCosineAndSineOfStrictMath_bitForBit() {
        long seed = 11;
        var random = new Random(seed);
        for (int i = 0; i < 1_000_000; i++) {
            assertSameAsStrictMath((random.nextDouble() - 0.5) * 12);
        }
    }

    @Test
    void angles_nearMultiplesOfAnEighthTurn_haveTheCosineAndSineOfStrictMath_bitForBit() {
        for (int eighth = -12; eighth <= 12; eighth++) {
            double angle = eighth * StrictMath.PI / 4;
            for (int i = -2_000; i <= 2_000; i++) {
                assertSameAsStrictMath(angle + i * Math.ulp(angle));
                assertSameAsStrictMath(angle + i * 1e-9);
                assertSameAsStrictMath(angle + i * 1e-4);
            }
        }
    }

    @Test
    void angles_thatAreTinyHugeOrNone_haveTheCosineAndSineOfStrictMath_bitForBit() {
        double[] angles = {0.0, -0.0, Double.MIN_VALUE, 1e-300, -1e-9, 0x1p-27, 0.3, 0.78125, 0.7852, 5, -5, 1e6, 1e22};
        for (double angle : angles) {
            assertSameAsStrictMath(angle);
            assertSameAsStrictMath(Math.nextUp(angle));
            assertSameAsStrictMath(-Math.nextDown(angle));
        }
        direction.set(Double.NaN);
        assertThat(direction.cos()).isNaN();
    }
}
