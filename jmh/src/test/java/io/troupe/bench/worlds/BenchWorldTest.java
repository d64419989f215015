package io.troupe.bench.worlds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.List;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

class BenchWorldTest {
    private static final int INTERVALS_PER_SECOND = 1000 / TiledScene.INTERVAL_MILLIS;

    @Test
    void readings_agree_afterASecondWithoutDriving() {
        assertThat(Agreement.check(BuildScene.FULL, 2, List.of(WorldKind.values()))
                        .largestM())
                .isLessThan(0.001);
        assertThat(Agreement.check(BuildScene.FULL, 70, List.of(WorldKind.values()))
                        .grazing())
                .isZero();
    }

    @ParameterizedTest
    @EnumSource(names = {"SONARS", "LASERS", "CAVE"})
    void readings_agree_inOtherScenes(BuildScene scene) {
        // jbox2d reports other distances for most of these rays; dyn4j the same as ours
        List<WorldKind> contenders = scene == BuildScene.LASERS
                ? List.of(WorldKind.TROUPE, WorldKind.TROUPE_2, WorldKind.DYN4J)
                : List.of(WorldKind.values());
        assertThat(Agreement.check(scene, 32, contenders).largestM()).isLessThan(0.02);
    }

    @ParameterizedTest
    @EnumSource
    void robots_drive_andSenseNearlyTheSameAsOurs(WorldKind kind) {
        var ours = WorldKind.TROUPE.create(TiledScene.of(2), true);
        var theirs = kind.create(TiledScene.of(2), true);
        double beforeM = theirs.readings().sonarM(0, 0) + theirs.readings().sonarM(1, 0);
        ours.advance(INTERVALS_PER_SECOND);
        theirs.advance(INTERVALS_PER_SECOND);
        var readings = theirs.readings();
        assertThat(readings.sonarM(0, 0) + readings.sonarM(1, 0)).isNotCloseTo(beforeM, within(0.1));
        // a ray may just miss what another contender's ray hits
        assertThat(IntStream.range(0, 2 * TiledScene.SONARS)
                        .filter(ray -> Math.abs(readings.sonarM(ray / 16, ray % 16)
                                        - ours.readings().sonarM(ray / 16, ray % 16))
                                > 0.05)
                        .count())
                .isLessThanOrEqualTo(2);
    }

    @Test
    void scene_hasRobotsApart_andNineObjectsATile() {
        var spec = TiledScene.of(130);
        assertThat(spec.robots()).hasSize(130);
        assertThat(spec.robots().stream()
                        .map(each -> each.pose().x() + " " + each.pose().y()))
                .doesNotHaveDuplicates();
        assertThat(spec.obstacles()).hasSize(4 + 4 * 9);
    }

    @Test
    void camera_seesColours_inSomeRobot() {
        var readings = WorldKind.TROUPE.create(TiledScene.of(64), true).readings();
        assertThat(IntStream.range(0, 64).map(i -> readings.colouredLeft[i] + readings.colouredRight[i]))
                .anyMatch(columns -> columns > 0);
    }

    @Test
    void turn_runsAtLeastOnce_andReadsBackFromItsLine() {
        var turn = WorldTurn.run(WorldKind.TROUPE.create(TiledScene.of(1), true), 0, 0);
        assertThat(turn.factor()).isPositive();
        assertThat(WorldTurn.parse(turn.line())).isEqualTo(turn);
    }
}
