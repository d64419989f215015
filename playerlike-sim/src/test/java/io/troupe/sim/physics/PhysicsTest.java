package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Specs;
import io.troupe.sim.scenario.Pose;
import org.jbox2d.common.Settings;
import org.junit.jupiter.api.Test;

class PhysicsTest {
    private static final int STEP_MICROS = 10_000;

    /** Robots on a square lattice that drive circles of their own, so that their boxes move all the time. */
    private static Physics circlingRobots(int side) {
        var physics = new Physics(side * side, STEP_MICROS, 0);
        physics.addObstacle(new Pose(-1, 0, 0), Specs.box(0.2, 2.0 * side, 0));
        for (int i = 0; i < side * side; i++) {
            var start = new Pose(2 * (i % side), 2 * (i / side), i);
            physics.addRobot(start, Specs.box(0.44, 0.38, -0.04), 23);
            physics.drive(i, 0.2, 0.5);
        }
        return physics;
    }

    @Test
    void repairedTree_reinsertsFewOfTheBoxesThatMove() {
        Physics physics = circlingRobots(5);
        for (int i = 0; i < 1000; i++) {
            physics.step();
        }

        assertThat(physics.tree().moveCount()).isGreaterThanOrEqualTo(25_000 - 25);
        assertThat(physics.tree().reinsertCount()).isBetween(1L, physics.tree().moveCount() / 10);
    }

    @Test
    void skin_isThatOfTwoPolygons() {
        assertThat(Physics.SKIN_M).isCloseTo(2.0 * Settings.polygonRadius, within(1e-8));
    }

    @Test
    void sineTable_isStandardHere() {
        assertThat(Physics.hasStandardSineTable()).isTrue();
    }

    @Test
    void bodyAngle_staysWrapped_howeverLongTheRobotTurns() {
        var physics = new Physics(1, STEP_MICROS, 0);
        physics.addRobot(Pose.ORIGIN, Specs.box(0.44, 0.38, -0.04), 23);
        physics.drive(0, 0, 10);
        for (int i = 0; i < 60_000; i++) {
            physics.step();
        }

        Pose end = physics.pose(0);
        assertThat(StrictMath.IEEEremainder(end.headingRad() - 6000, 2 * StrictMath.PI)).isCloseTo(0, within(1e-6));
        assertThat(end.x()).isCloseTo(0, within(1e-9));
        assertThat(physics.bodyHeadingRad(0)).isCloseTo(end.headingRad(), within(1e-6));
    }

    @Test
    void body_followsThePose() {
        Physics physics = circlingRobots(3);
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
        Physics physics = circlingRobots(1);

        assertThatThrownBy(() -> physics.addObstacle(Pose.ORIGIN, Specs.box(1, 1, 0)))
                .isInstanceOf(IllegalStateException.class);
    }
}
