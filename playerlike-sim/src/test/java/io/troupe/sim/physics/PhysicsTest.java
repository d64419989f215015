package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.TestWorlds;
import io.troupe.sim.model.Pose;
import org.jbox2d.common.Settings;
import org.junit.jupiter.api.Test;

class PhysicsTest {
    private static final int STEP_MICROS = 10_000;

    /** Robots in a grid, driving circles. */
    private static Physics circling(int robots) {
        var physics = new Physics(robots, STEP_MICROS);
        for (int robot = 0; robot < robots; robot++) {
            physics.addRobot(new Pose(robot % 10 * 2 - 9, robot / 10 * 2, robot), TestWorlds.box(0.4, 0.3), 10);
            physics.drive(robot, 0.3, 0.5);
        }
        return physics;
    }

    @Test
    void robotsOnTheirOwn_hardlyConcernTheTree() {
        var physics = new Physics(30, STEP_MICROS);
        for (int robot = 0; robot < 30; robot++) {
            physics.addRobot(new Pose(robot % 10 * 5 - 20, robot / 10 * 5, robot), TestWorlds.box(0.4, 0.3), 10);
            physics.drive(robot, 0.3, 0.5);
        }
        for (int step = 0; step < 1_000; step++) {
            physics.step();
        }
        RepairedTree tree = physics.tree();
        assertThat(tree.reinsertCount()).as("of 30,000 steps").isLessThan(3_000).isPositive();
        assertThat(tree.moveCount()).as("of 30,000 steps").isLessThan(4_000);
    }

    @Test
    void repairedTree_reinsertsFewMoves() {
        var physics = new Physics(2, STEP_MICROS); // so near each other that jbox2d moves them at every step
        physics.addRobot(new Pose(0, 0.18, 0), TestWorlds.box(0.4, 0.3), 10);
        physics.addRobot(new Pose(0, -0.18, 0), TestWorlds.box(0.4, 0.3), 10);
        physics.drive(0, 0.3, 0);
        physics.drive(1, 0.3, 0);
        for (int step = 0; step < 1_000; step++) {
            physics.step();
        }
        RepairedTree tree = physics.tree();
        assertThat(tree.moveCount()).isEqualTo(2_000);
        assertThat(tree.reinsertCount())
                .as("of %d moves", tree.moveCount())
                .isLessThan(tree.moveCount() / 10)
                .isPositive();
    }

    @Test
    void angles_areWrapped_soThatALongTurnStaysExact() {
        var physics = new Physics(1, STEP_MICROS);
        physics.addRobot(Pose.ORIGIN, TestWorlds.box(0.4, 0.3), 10);
        double perStep = StrictMath.PI / 500;
        physics.drive(0, 0, perStep * 100);
        for (int step = 0; step < 100_000; step++) { // 100 turns
            physics.step();
        }
        assertThat(physics.pose(0).headingRad()).isCloseTo(0, within(1e-8));
    }

    @Test
    void robotFarFromTheOrigin_drivesAsFarAsOneAtIt() {
        var physics = new Physics(1, STEP_MICROS);
        physics.addRobot(new Pose(300, 0, 0), TestWorlds.box(0.4, 0.3), 10);
        physics.drive(0, 0.1, 0);
        for (int step = 0; step < 6_000; step++) {
            physics.step();
        }
        assertThat(physics.pose(0).x()).isCloseTo(306, within(1e-8)); // single precision alone would be 4 cm off
    }

    @Test
    void sineTable_isTheStandardOneOnThisMachine() {
        assertThat(Physics.hasStandardSineTable()).isTrue();
    }

    @Test
    void skin_isThatOfTwoPolygons() {
        assertThat(Physics.SKIN_M).isCloseTo(2.0 * Settings.polygonRadius, within(1e-8));
    }

    @Test
    void body_followsThePose() {
        Physics physics = circling(9);
        for (int i = 0; i < 5000; i++) {
            physics.step();
        }

        for (int i = 0; i < 9; i++) {
            double apart = StrictMath.IEEEremainder(
                    physics.bodyHeadingRad(i) - physics.pose(i).headingRad(), 2 * StrictMath.PI);
            assertThat(apart).as("robot %d", i).isCloseTo(0, within(1e-6));
        }
    }

    @Test
    void obstacleAfterARobot_isRefused() {
        Physics physics = circling(1);

        assertThatThrownBy(() -> physics.addObstacle(Pose.ORIGIN, TestWorlds.box(1, 1)))
                .isInstanceOf(IllegalStateException.class);
    }
}
