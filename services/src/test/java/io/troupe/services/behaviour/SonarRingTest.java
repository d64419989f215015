package io.troupe.services.behaviour;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class SonarRingTest {
    /** A ring whose sonars read 5 m, except those in the arguments: alternately a sonar and its range. */
    static SonarRing ring(Object... sonarAndRange) {
        var ranges = new float[16];
        java.util.Arrays.fill(ranges, 5f);
        for (int i = 0; i < sonarAndRange.length; i += 2) {
            ranges[(Integer) sonarAndRange[i]] = ((Double) sonarAndRange[i + 1]).floatValue();
        }
        return SonarRing.of(ranges);
    }

    @Test
    void readings_areClampedToWhatTheLawsExpect() {
        SonarRing ring = ring(0, 0.05, 1, 12.0, 2, 1.5);
        assertThat(ring.rangeM(0)).isEqualTo(0.2);
        assertThat(ring.rangeM(1)).isEqualTo(5.0);
        assertThat(ring.rangeM(2)).isEqualTo(1.5);
    }

    @Test
    void groups_takeTheNearestOfTheirSonars() {
        SonarRing ring = ring(0, 3.0, 1, 0.75, 2, 2.0, 3, 4.0, 4, 1.25, 5, 0.5);
        assertThat(ring.leftM()).isEqualTo(0.75);
        assertThat(ring.frontM()).isEqualTo(1.25);
    }

    @Test
    void ringOfFewerThanEight_isRefused() {
        assertThatThrownBy(() -> SonarRing.of(new float[] {1, 2, 3}))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a sonar ring has 3 readings, expected 8 or more");
    }

    @Test
    void readingThatIsNotANumber_isRefused() {
        assertThatThrownBy(() -> ring(6, Double.NaN)).hasMessage("sonar 6 reads NaN, expected metres");
    }
}
