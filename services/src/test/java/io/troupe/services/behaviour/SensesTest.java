package io.troupe.services.behaviour;

import static io.troupe.services.behaviour.TestSenses.blob;
import static io.troupe.services.behaviour.TestSenses.ring;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/** What a behaviour senses: blobs, colours, sonar ring and laser scan, and the time of its readings. */
class SensesTest {
    private static final int RED = 0xFF0000;
    private static final int GREEN = 0x00FF00;

    private final ReadingTime time = new ReadingTime();

    private static Senses seeing(Blob... blobs) {
        return new Senses(0, ring(), new RobotPose(0, 0, 0), false, List.of(blobs), LaserScan.EMPTY);
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
        var senses = seeing(blob(GREEN, 900, 0), blob(RED, 50, 30), blob(RED, 60, 40), blob(RED, 60, 9));
        assertThat(senses.largestBlob(RED)).hasValue(blob(RED, 60, 9));
        assertThat(seeing(blob(GREEN, 900, 0)).largestBlob(RED)).isEmpty();
    }

    @Test
    void offset_goesFromOneAtTheLeftEdgeToMinusOneAtTheRight_andBearingIsItsShareOfTheView() {
        assertThat(columns(0, 79).offset()).isZero();
        assertThat(columns(39, 40).offset()).isZero();
        // from edge to edge the offset changes by 2, so a column of 80 is 1/40; its centre is 1/80 from the edge
        assertThat(columns(0, 0).offset()).isEqualTo(1 - 1 / 80.0);
        assertThat(columns(79, 79).offset()).isEqualTo(-1 + 1 / 80.0);
        assertThat(new Blob(RED, 100, 35, 45, 0, 0, 0, 0, 1).offset()).isZero();
        double sixty = Math.toRadians(60);
        assertThat(columns(0, 39).bearingRad(sixty)).isCloseTo(Math.toRadians(15), within(1e-12));
        assertThat(columns(40, 79).bearingRad(sixty)).isCloseTo(Math.toRadians(-15), within(1e-12));
    }

    @Test
    void scan_hasABearingForEachBeam_andTheNearestBetweenTwo_andOnlyNumbers() {
        var scan = LaserScan.of(-1, 1, 8, new float[] {5, 4, 1, 2, 3});
        assertThat(IntStream.of(0, 1, 2, 4).mapToDouble(scan::bearingRad)).containsExactly(-1.0, -0.5, 0.0, 1.0);
        assertThat(scan.nearestM(-1, -0.5)).isEqualTo(4);
        assertThat(scan.nearestM(-1, 1)).isEqualTo(1);
        assertThat(scan.nearestM(0.6, 0.9)).isEqualTo(8);
        assertThat(scan.rangeM(4)).isEqualTo(3);
        assertThat(scan.size()).isEqualTo(5);
        assertThat(LaserScan.of(-1, 1, 8, new float[] {2}).bearingRad(0)).isZero();
        assertThat(LaserScan.of(0.25, 0.25, 8, new float[] {2}).bearingRad(0)).isEqualTo(0.25);
        assertThatThrownBy(() -> LaserScan.of(-1, 1, 8, new float[] {1, Float.NaN}))
                .hasMessage("laser beam 1 reads NaN, expected metres");
    }

    @Test
    void ring_isClampedToWhatTheLawsExpect_itsGroupsTakeTheNearest_andItHasEightNumbersOrMore() {
        SonarRing clamped = ring(0, 0.05, 1, 12.0, 2, 1.5);
        assertThat(IntStream.of(0, 1, 2).mapToDouble(clamped::rangeM)).containsExactly(0.2, 5.0, 1.5);
        SonarRing ring = ring(0, 3.0, 1, 0.75, 2, 2.0, 3, 4.0, 4, 1.25, 5, 0.5);
        assertThat(ring.leftM()).isEqualTo(0.75);
        assertThat(ring.frontM()).isEqualTo(1.25);
        assertThatThrownBy(() -> SonarRing.of(new float[] {1, 2, 3}))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a sonar ring has 3 readings, expected 8 or more");
        assertThatThrownBy(() -> ring(6, Double.NaN)).hasMessage("sonar 6 reads NaN, expected metres");
    }

    @Test
    void colourFinder_findsTheLargestSightingOfInterest_ofEqualOnesTheLeftmost_belowTenPixelsNone() {
        var seen = List.of(blob(RED, 50, 0), blob(GREEN, 60, 40), blob(0, 900, 60));
        assertThat(ColourFinder.find(seen, colour -> colour != 0)).hasValue(GREEN);
        var equal = List.of(blob(RED, 50, 30), blob(GREEN, 50, 10));
        assertThat(ColourFinder.find(equal, colour -> true)).hasValue(GREEN);
        assertThat(ColourFinder.find(List.of(blob(RED, 90, 0)), colour -> colour == GREEN))
                .isEmpty();
        assertThat(ColourFinder.find(List.of(blob(RED, 9, 0)), colour -> true))
                .as("noise")
                .isEmpty();
        assertThat(ColourFinder.find(List.of(blob(RED, 10, 0)), colour -> true)).hasValue(RED);
    }

    @Test
    void priorities_countBeforeAreas_theSmallestOfAllNumbersTooComesLast() {
        var seen = List.of(blob(RED, 90, 0), blob(GREEN, 50, 10), blob(0, 60, 20));
        Map<Integer, Integer> priorities = Map.of(RED, Integer.MIN_VALUE, GREEN, 0, 0, Integer.MAX_VALUE);
        assertThat(ColourFinder.inOrder(seen, priorities::get)).containsExactly(0, GREEN, RED);
    }

    @Test
    void clockThatIsNotSetBack_isTheTimeItself_bitForBit() {
        for (double stamp : new double[] {-3.1, 0, 0.1, 0.30000000000000004, 1.7e9, 1.7e9 + 60}) {
            assertThat(time.at(stamp)).isEqualTo(stamp);
            assertThat(time.at(stamp)).as("asked again").isEqualTo(stamp);
        }
    }

    @Test
    void clockThatIsSetBack_goesOnByACycle_eachTime() {
        time.at(100);
        assertThat(time.at(40)).isCloseTo(100.1, within(1e-9));
        assertThat(time.at(40)).isCloseTo(100.1, within(1e-9));
        assertThat(time.at(40.1)).isCloseTo(100.2, within(1e-9));
        assertThat(time.at(-20)).isCloseTo(100.3, within(1e-9));
        assertThat(time.at(40)).as("a minute forward").isCloseTo(160.3, within(1e-9));
    }

    @Test
    void stampsThatJitter_areTheSameTime_andNoCycle() {
        double seconds = time.at(100);
        for (int i = 0; i < 1000; i++) {
            assertThat(time.at(99.999)).isEqualTo(seconds);
            assertThat(time.at(100)).isEqualTo(seconds);
        }
        assertThat(time.at(99.95)).isEqualTo(seconds);
        assertThat(time.at(100.05)).as("no cycle was added").isEqualTo(100.05);
        assertThat(time.at(100.02)).isEqualTo(100.05);
        assertThat(time.at(99.9)).as("set back by more than a cycle").isCloseTo(100.15, within(1e-9));
    }

    @Test
    void cycle_isAHundredMilliseconds_orAStepOfTheClock() {
        assertThat(ReadingTime.isCycle(Double.NEGATIVE_INFINITY, 0)).isTrue();
        assertThat(ReadingTime.isCycle(1, 1.0996)).isTrue();
        assertThat(ReadingTime.isCycle(1, 1.05)).isFalse();
        assertThat(ReadingTime.isCycle(1, 1)).isFalse();
        assertThat(ReadingTime.isCycle(100, 40)).isTrue();
    }
}
