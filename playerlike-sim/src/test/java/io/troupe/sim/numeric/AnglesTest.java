package io.troupe.sim.numeric;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Random;
import org.junit.jupiter.api.Test;

class AnglesTest {
    private static void assertWrapped(double angleRad) {
        assertThat(Double.doubleToRawLongBits(Angles.wrap(angleRad)))
                .as("bits of the wrapped angle %s", angleRad)
                .isEqualTo(Double.doubleToRawLongBits(StrictMath.IEEEremainder(angleRad, 2 * StrictMath.PI)));
    }

    @Test
    void wrap_isTheRemainder_bitForBit() {
        long seed = 11;
        var random = new Random(seed);
        for (int i = 0; i < 200_000; i++) {
            assertWrapped(random.nextDouble(-30, 30));
        }
        for (int quarters = -20; quarters <= 20; quarters++) {
            double angleRad = quarters * StrictMath.PI / 2;
            for (int ulps = 0; ulps < 50; ulps++) {
                assertWrapped(angleRad + ulps * Math.ulp(angleRad));
                assertWrapped(angleRad - ulps * Math.ulp(angleRad));
            }
        }
        assertWrapped(-0.0);
        assertWrapped(1e300);
    }
}
