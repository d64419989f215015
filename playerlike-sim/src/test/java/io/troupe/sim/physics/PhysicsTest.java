package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.TestWorlds;
import io.troupe.sim.scenario.Pose;
import org.jbox2d.collision.AABB;
import org.jbox2d.common.Vec2;
import org.junit.jupiter.api.Test;

class PhysicsTest {
    private static final int STEP_MICROS = 10_000;

    /** Robots in a grid, driving circles. */
    private static Physics circling(int robots) {
        var physics = new Physics(robots, STEP_MICROS, false);
        for (int robot = 0; robot < robots; robot++) {
            physics.addRobot(new Pose(robot % 10 * 2 - 9, robot / 10 * 2, robot), TestWorlds.box(0.4, 0.3), 10);
            physics.drive(robot, 0.3, 0.5);
        }
        return physics;
    }

    @Test
    void repairedTree_reinsertsFewMoves() {
        Physics physics = circling(30);
        for (int step = 0; step < 1_000; step++) {
            physics.step();
        }
        RepairedTree tree = physics.tree();
        assertThat(tree.moveCount()).isEqualTo(30_000);
        assertThat(tree.reinsertCount())
                .as("of %d moves", tree.moveCount())
                .isLessThan(tree.moveCount() / 10)
                .isPositive();
    }

    @Test
    void repairedTree_noticesABoxThatOutgrowsItsMarginOnAllSides() {
        var tree = new RepairedTree();
        var small = new AABB(new Vec2(-1, -1), new Vec2(1, 1));
        var large = new AABB(new Vec2(-3, -3), new Vec2(3, 3));
        int proxy = tree.createProxy(small, "thing");
        assertThat(tree.moveProxy(proxy, large, new Vec2(0, 0))).isTrue();
        AABB fat = tree.getFatAABB(proxy);
        assertThat(fat.lowerBound.x).isLessThan(large.lowerBound.x);
        assertThat(fat.upperBound.y).isGreaterThan(large.upperBound.y);
        assertThat(tree.moveProxy(proxy, small, new Vec2(0, 0))).isFalse();
    }

    @Test
    void angles_areWrapped_soThatALongTurnStaysExact() {
        var physics = new Physics(1, STEP_MICROS, false);
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
        var physics = new Physics(1, STEP_MICROS, false);
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
}
