package io.troupe.sim.scenario;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.sim.RobotReading;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class CrowdWorldTest {
    @ParameterizedTest
    @ValueSource(ints = {1, 2, 64, 65, 300})
    void crowd_ofAnySize_hasItsRobotsApartAndInsideTheWalls(int robots) {
        Scenario crowd = CrowdWorld.scenario(robots);

        // the reader refuses robots that overlap or stand outside
        assertThat(crowd.world().robots()).hasSize(robots);
        assertThat(crowd.world().robots().getFirst().name()).isEqualTo("robot1");
        assertThat(crowd.devices()).hasSize(1 + 3 * robots);
        assertThat(crowd.devices().getLast().index()).isEqualTo(robots - 1);
    }

    @Test
    void crowd_growsByWholeHalls() {
        assertThat(extent(64)).isEqualTo(16.2);
        assertThat(extent(65)).isEqualTo(32.2);
        assertThat(extent(4 * 64)).isEqualTo(32.2);
        assertThat(extent(4 * 64 + 1)).isEqualTo(48.2);
        assertThat(CrowdWorld.scenario(65).world().obstacles()).hasSize(2 * 3 + 2 * 9);
    }

    private static double extent(int robots) {
        Box box = Box.NOTHING;
        for (ObstacleSpec wall : CrowdWorld.scenario(robots).world().obstacles()) {
            box = box.union(Box.around(wall.shape().at(wall.pose()).polygons()));
        }
        return box.width();
    }

    @Test
    void crowd_drivingForTenSeconds_staysInsideItsHall() {
        World world = World.create(CrowdWorld.scenario(70).world(), WorldSettings.DEFAULT);
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
    @ValueSource(ints = {0, -1, CrowdWorld.MOST_ROBOTS + 1})
    void crowd_ofNobodyOrTooMany_isRefused(int robots) {
        assertThatIllegalArgumentException()
                .isThrownBy(() -> CrowdWorld.text(robots))
                .withMessage("a crowd has " + robots + " robots, expected from 1 to 20000");
    }
}
