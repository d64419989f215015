package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.sim.RobotReading;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Scenario;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class CrowdWorldTest extends WorldFiles {
    private static Box around(ObstacleSpec obstacle) {
        return Box.around(obstacle.shape().at(obstacle.pose()).polygons());
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2, 64, 65, 300})
    void crowd_ofAnySize_hasItsRobotsApartAndInsideTheWalls(int robots) {
        // the reader rejects robots that stand outside, and warns of those that overlap
        assertThat(warnings(CrowdWorld.text(robots))).isEmpty();

        Scenario crowd = CrowdWorld.scenario(robots);
        assertThat(crowd.world().robots()).hasSize(robots);
        assertThat(crowd.world().robots().getFirst().name()).isEqualTo("robot1");
        assertThat(crowd.devices()).hasSize(1 + 3 * robots);
        assertThat(crowd.devices().getLast().index()).isEqualTo(robots - 1);
    }

    @Test
    void crowd_growsByWholeHalls() {
        assertThat(Stream.of(64, 65, 4 * 64, 4 * 64 + 1).map(CrowdWorldTest::extentM))
                .containsExactly(16.2, 32.2, 32.2, 48.2);
        assertThat(CrowdWorld.scenario(65).world().obstacles()).hasSize(2 * 3 + 2 * 9);
        assertThat(Integer.toHexString(CrowdWorld.text(65).hashCode()))
                .as("the text of a crowd never changed")
                .isEqualTo("71cc2686");
    }

    private static double extentM(int robots) {
        return CrowdWorld.scenario(robots).world().obstacles().stream()
                .map(CrowdWorldTest::around)
                .reduce(Box.NOTHING, Box::union)
                .width();
    }

    @Test
    void crowd_drivingForTenSeconds_staysInsideItsHall() {
        World world = World.create(CrowdWorld.scenario(70).world(), WorldSettings.defaults());
        for (int tick = 0; tick < 100; tick++) {
            for (int robot = 0; robot < 70; robot++) {
                world.command(robot, 0.4, 0.2);
            }
            for (RobotReading robot : world.advance().robots()) {
                assertThat(robot.wallGapM()).isPositive();
            }
        }
        assertThat(world.latest().robots().subList(0, 64))
                .allSatisfy(robot -> assertThat(robot.pose().x()).isNegative());
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 3, 8, 50, CrowdWorld.MOST_COLOURS})
    void colours_areDifferentFromEachOtherAndFromWallsAndRobots(int colours) {
        assertThat(CrowdWorld.colours(colours))
                .hasSize(colours)
                .doesNotHaveDuplicates()
                .doesNotContain(0, 0xffa500);
        assertThat(CrowdWorld.colours(3)).containsExactly(0x0000ff, 0xff0000, 0x00ff00);

        Scenario crowd = CrowdWorld.scenario(70, colours);
        assertThat(crowd.world().obstacles().stream().map(ObstacleSpec::colour).filter(colour -> colour != 0))
                .as("the panels of two halls")
                .hasSize(2 * colours)
                .containsAll(CrowdWorld.colours(colours));
        assertThat(crowd.world().robots().getFirst().blobfinder().colours())
                .containsExactlyInAnyOrderElementsOf(CrowdWorld.colours(colours));
    }

    @Test
    void panels_standApart() {
        List<Box> panels = CrowdWorld.scenario(1, CrowdWorld.MOST_COLOURS).world().obstacles().stream()
                .filter(obstacle -> obstacle.colour() != 0)
                .map(CrowdWorldTest::around)
                .toList();
        for (int i = 0; i < panels.size(); i++) {
            for (int j = 0; j < i; j++) {
                Box one = panels.get(i);
                Box other = panels.get(j);
                Box both = one.union(other);
                assertThat(both.width() > one.width() + other.width() || both.height() > one.height() + other.height())
                        .as("panels %d and %d are apart", i, j)
                        .isTrue();
            }
        }
    }

    @Test
    void crowd_withoutRobotsOrColoursOrWithTooMany_isRefused() {
        for (int robots : new int[] {0, -1, CrowdWorld.MOST_ROBOTS + 1}) {
            assertThatIllegalArgumentException()
                    .isThrownBy(() -> CrowdWorld.text(robots))
                    .withMessage("a crowd has " + robots + " robots, expected from 1 to 20000");
        }
        for (int colours : new int[] {0, CrowdWorld.MOST_COLOURS + 1}) {
            assertThatIllegalArgumentException()
                    .isThrownBy(() -> CrowdWorld.text(1, colours))
                    .withMessage("a crowd's halls have " + colours + " colours, expected from 1 to 100");
        }
    }
}
