package io.troupe.services.behaviour;

import static io.troupe.services.behaviour.SonarRingTest.ring;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.services.behaviour.GoToGoal.Goal;
import io.troupe.services.behaviour.GoToGoal.Step;
import java.util.List;
import java.util.Optional;
import java.util.Random;
import org.junit.jupiter.api.Test;

class GoToGoalTest {
    private static final Goal EAST = new Goal(2, 0);
    private static final Goal NORTH = new Goal(2, 2);

    private static GoToGoal to(Goal... goals) {
        return new GoToGoal(List.of(goals), 0.3, 0.1, false);
    }

    private static Velocity velocity(GoToGoal law, RobotPose pose) {
        return law.step(0, pose).velocity().orElseThrow();
    }

    @Test
    void goalStraightAhead_isDrivenToAtFullSpeed() {
        assertThat(velocity(to(EAST), new RobotPose(0, 0, 0))).isEqualTo(new Velocity(0.3, 0));
    }

    @Test
    void nearGoal_isApproachedInProportionToTheDistance() {
        assertThat(velocity(to(EAST), new RobotPose(1.8, 0, 0)).forwardMps()).isCloseTo(0.2, within(1e-12));
    }

    @Test
    void goalToTheSide_isTurnedTo_slowerTheFartherItIsAside() {
        Velocity left = velocity(to(new Goal(1, 1)), new RobotPose(0, 0, 0));
        assertThat(left.forwardMps()).isCloseTo(0.3 * Math.cos(Math.PI / 4), within(1e-12));
        assertThat(left.turnRadps()).isEqualTo(0.8); // 1.5 * pi / 4 would be more
        Velocity right = velocity(to(EAST), new RobotPose(0, 0, 0.2));
        assertThat(right.turnRadps()).isCloseTo(-0.3, within(1e-12));
    }

    @Test
    void goalBehind_isTurnedToInPlace_theShorterWayRound() {
        Velocity turn = velocity(to(new Goal(-1, 0.1)), new RobotPose(0, 0, -3));
        assertThat(turn.forwardMps()).isPositive(); // the goal is almost in front: the angle wraps at pi
        assertThat(turn.turnRadps()).isNegative();
        assertThat(velocity(to(EAST), new RobotPose(0, 0, 3)).forwardMps()).isZero();
    }

    @Test
    void lastGoal_leavesItWithNothingToSay_untilItIsMovedAway() {
        Step there = to(EAST).step(0, new RobotPose(1.95, 0, 1));
        assertThat(there).isEqualTo(new Step(Optional.empty(), 0));
        assertThat(to(EAST).step(there.goal(), new RobotPose(1.5, 0, 0)).velocity())
                .isPresent();
    }

    @Test
    void goals_areVisitedInTurn_andAgainWhenAsked() {
        Step first = to(EAST, NORTH).step(0, new RobotPose(2, 0, Math.PI / 2));
        assertThat(first.goal()).isEqualTo(1);
        assertThat(first.velocity().orElseThrow().forwardMps()).isCloseTo(0.3, within(1e-12));
        assertThat(to(EAST, NORTH).step(1, new RobotPose(2, 2, 0)).velocity()).isEmpty();
        var round = new GoToGoal(List.of(EAST, NORTH), 0.3, 0.1, true);
        assertThat(round.step(1, new RobotPose(2, 2, 0)).goal()).isZero();
        var onOnePoint = new GoToGoal(List.of(EAST, EAST), 0.3, 0.1, true);
        assertThat(onOnePoint.step(0, new RobotPose(2, 0, 0)).velocity()).isEmpty();
    }

    @Test
    void robotThatDoesAsItIsTold_arrives_andNeverOvershoots() {
        var random = new Random(4);
        for (int run = 0; run < 200; run++) {
            var goal = new Goal(random.nextDouble(-5, 5), random.nextDouble(-5, 5));
            Behaviour law = to(goal).behaviour();
            double x = 0;
            double y = 0;
            double heading = random.nextDouble(-Math.PI, Math.PI);
            boolean arrived = false;
            for (int cycle = 0; cycle < 600 && !arrived; cycle++) {
                var wanted = law.step(new Senses(cycle * 0.1, ring(), new RobotPose(x, y, heading)));
                arrived = wanted.isEmpty();
                Velocity velocity = wanted.orElse(Velocity.STOP);
                double before = Math.hypot(goal.xM() - x, goal.yM() - y);
                x += 0.1 * velocity.forwardMps() * Math.cos(heading);
                y += 0.1 * velocity.forwardMps() * Math.sin(heading);
                heading += 0.1 * velocity.turnRadps();
                assertThat(Math.hypot(goal.xM() - x, goal.yM() - y)).isLessThanOrEqualTo(before + 1e-9);
            }
            assertThat(arrived).as("run %d to %s", run, goal).isTrue();
        }
    }

    @Test
    void numbersThatMakeNoSense_areRefused() {
        assertThatThrownBy(() -> to()).hasMessage("a way of 0 goals, expected 1 or more");
        assertThatThrownBy(() -> to(new Goal(Double.NaN, 0))).hasMessageContaining("expected finite metres");
        assertThatThrownBy(() -> new GoToGoal(List.of(EAST), 0, 0.1, false))
                .hasMessage("the speed is 0.0 m/s, expected more than 0");
        assertThatThrownBy(() -> new GoToGoal(List.of(EAST), 0.3, -1, false)).hasMessageContaining("-1.0 m");
    }
}
