package io.troupe.services.behaviour;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.Test;

class SensesTest {
    private static final int RED = 0xFF0000;
    private static final int GREEN = 0x00FF00;

    private static Senses seeing(Blob... blobs) {
        var ranges = new float[8];
        Arrays.fill(ranges, 5);
        return new Senses(
                0, SonarRing.of(ranges), new RobotPose(0, 0, 0), false, Arrays.asList(blobs), LaserScan.EMPTY);
    }

    private static Blob columns(int leftPx, int rightPx) {
        return new Blob(RED, 100, leftPx, rightPx, 25, 35, 80, 60, 1);
    }

    @Test
    void threeArguments_areARobotThatSeesNothing_andIsNotStalled() {
        var senses = new Senses(1, SonarRing.of(new float[8]), new RobotPose(0, 0, 0));
        assertThat(senses.stalled()).isFalse();
        assertThat(senses.blobs()).isEmpty();
        assertThat(senses.laser().isEmpty()).isTrue();
    }

    @Test
    void largestBlob_isTheLargestOfTheColour_ofEqualOnesTheLeftmost() {
        var senses = seeing(
                TestBlobs.of(GREEN, 900, 0),
                TestBlobs.of(RED, 50, 30),
                TestBlobs.of(RED, 60, 40),
                TestBlobs.of(RED, 60, 9));
        assertThat(senses.largestBlob(RED)).hasValue(TestBlobs.of(RED, 60, 9));
        assertThat(seeing(TestBlobs.of(GREEN, 900, 0)).largestBlob(RED)).isEmpty();
    }

    @Test
    void offset_goesFromOneAtTheLeftEdgeToMinusOneAtTheRight() {
        assertThat(columns(0, 79).offset()).isZero();
        assertThat(columns(39, 40).offset()).isZero();
        // from edge to edge the offset changes by 2, so a column of 80 is 1/40; its centre is 1/80 from the edge
        assertThat(columns(0, 0).offset()).isEqualTo(1 - 1 / 80.0);
        assertThat(columns(79, 79).offset()).isEqualTo(-1 + 1 / 80.0);
        assertThat(new Blob(RED, 100, 35, 45, 0, 0, 0, 0, 1).offset()).isZero();
    }

    @Test
    void bearing_isTheShareOfHalfTheFieldOfView() {
        double sixty = Math.toRadians(60);
        assertThat(columns(0, 39).bearingRad(sixty)).isCloseTo(Math.toRadians(15), within(1e-12));
        assertThat(columns(40, 79).bearingRad(sixty)).isCloseTo(Math.toRadians(-15), within(1e-12));
    }

    @Test
    void scan_hasABearingForEachBeam_andTheNearestBetweenTwo() {
        var scan = LaserScan.of(-1, 1, 8, new float[] {5, 4, 1, 2, 3});
        assertThat(List.of(scan.bearingRad(0), scan.bearingRad(1), scan.bearingRad(2), scan.bearingRad(4)))
                .containsExactly(-1.0, -0.5, 0.0, 1.0);
        assertThat(scan.nearestM(-1, -0.5)).isEqualTo(4);
        assertThat(scan.nearestM(-1, 1)).isEqualTo(1);
        assertThat(scan.nearestM(0.6, 0.9)).isEqualTo(8);
        assertThat(scan.rangeM(4)).isEqualTo(3);
        assertThat(scan.size()).isEqualTo(5);
    }

    @Test
    void scan_ofOneBeam_hasItsBearing_andNoneWithoutANumberIsTaken() {
        assertThat(LaserScan.of(-1, 1, 8, new float[] {2}).bearingRad(0)).isZero();
        assertThat(LaserScan.of(0.25, 0.25, 8, new float[] {2}).bearingRad(0)).isEqualTo(0.25);
        assertThatThrownBy(() -> LaserScan.of(-1, 1, 8, new float[] {1, Float.NaN}))
                .hasMessage("laser beam 1 reads NaN, expected metres");
    }
}
