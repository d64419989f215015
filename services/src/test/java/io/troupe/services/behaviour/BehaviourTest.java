package io.troupe.services.behaviour;

import static io.troupe.services.behaviour.TestSenses.ring;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;
import static org.junit.jupiter.params.provider.Arguments.arguments;

import io.troupe.services.behaviour.Avoid.Memory.Onward;
import io.troupe.services.behaviour.Avoid.Memory.Turning;
import io.troupe.services.behaviour.GoToGoal.Goal;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.behaviour.WallFollower.Memory.Aligning;
import io.troupe.services.behaviour.WallFollower.Memory.Following;
import java.util.List;
import java.util.Optional;
import java.util.Random;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;

/** The four control laws: wall follower, space wanderer, avoid, and go to goal. */
class BehaviourTest {
    private static final WallFollower.Memory START = WallFollower.START;
    private static final Avoid AVOID = new Avoid(0.4, 0.6, 0.5, 1);
    private static final RobotPose ORIGIN = new RobotPose(0, 0, 0);
    private static final Goal EAST = new Goal(2, 0);
    private static final Goal NORTH = new Goal(2, 2);

    // ---- wall follower: tables 1 and 2 of the paper, row by row

    static Stream<Arguments> tables1And2() {
        var following = new Following();
        return Stream.of(
                arguments("1.1 nothing near: forward", START, ring(), 0.2, 0, START),
                arguments("1.2 wall ahead: right, fast", START, ring(3, 0.35), 0, -0.45, new Aligning(5)),
                arguments("1.2 again", new Aligning(5), ring(3, 0.35, 0, 1), 0, -0.45, new Aligning(1)),
                arguments(
                        "1.3 wall nearer on the left: right, slowly", START, ring(2, 0.35), 0, -0.15, new Aligning(5)),
                arguments("alignment goes on", new Aligning(0.5), ring(0, 0.5), 0, -0.15, new Aligning(0.5)),
                arguments("and ends when the left reading grows", new Aligning(0.5), ring(0, 0.51), 0, 0, following),
                arguments("2.1 wall ahead: right", following, ring(4, 0.39, 0, 0.35), 0.1, -0.6, following),
                arguments("2.2 wall too near: away", following, ring(0, 0.29), 0.1, -0.15, following),
                arguments("2.3 wall too far: towards it", following, ring(0, 0.41), 0.1, 0.15, following),
                arguments("2.4 wall at the right distance: forward", following, ring(0, 0.35), 0.2, 0, following),
                arguments("upper rows have priority", following, ring(3, 0.3, 0, 0.25), 0.1, -0.6, following));
    }

    @ParameterizedTest(name = "{0}")
    @MethodSource("tables1And2")
    void wallFollower_stepsByTheTablesOfThePaper(
            String row,
            WallFollower.Memory memory,
            SonarRing ring,
            double forwardMps,
            double turnRadps,
            WallFollower.Memory next) {
        assertThat(new WallFollower(CornerStyle.FORWARD).step(memory, ring))
                .isEqualTo(new WallFollower.Step(new Velocity(forwardMps, turnRadps), next));
    }

    @Test
    void wallFollower_withTheOtherCornerStyle_turnsAsThePapersModel() {
        assertThat(new WallFollower(CornerStyle.BACKWARD).step(new Following(), ring(4, 0.39, 0, 0.35)))
                .isEqualTo(new WallFollower.Step(new Velocity(-0.1, -0.6), new Following()));
    }

    @Test
    void wallFollower_withOtherNumbers_usesEachInItsRow() {
        var velocities =
                List.of(new Velocity(1, 0.1), new Velocity(2, 0.2), new Velocity(3, 0.3), new Velocity(4, 0.4));
        var law = new WallFollower(new WallFollower.Gains(
                0.8, 0.6, velocities.get(0), velocities.get(1), velocities.get(2), velocities.get(3)));
        assertThat(List.of(ring(0, 0.7), ring(4, 0.79, 0, 0.7), ring(0, 0.59), ring(0, 0.81)))
                .extracting(ring -> law.step(new Following(), ring).velocity())
                .isEqualTo(velocities);
        assertThat(law.step(START, ring(0, 0.81)).velocity()).isEqualTo(velocities.get(0));
    }

    // ---- space wanderer

    @Test
    void wanderer_drivesStraightInOpenSpace_andTurnsWhereThereIsMoreRoom_byThePapersFormula() {
        assertThat(SpaceWanderer.steer(ring())).isEqualTo(new Velocity(0.5, 0));
        Velocity velocity = SpaceWanderer.steer(ring(5, 1.0, 6, 3.0)); // left (5 + 5)/2, right (1 + 3)/2
        assertThat(velocity.forwardMps()).isCloseTo((0.5 + 0.2) / 2, within(1e-12));
        assertThat(velocity.turnRadps()).isCloseTo((0.5 - 0.2) * 57.29577951308232 / 24, within(1e-12));
    }

    @Test
    void wanderer_drivesOnIfOneSideIsFree_elseTurnsAwayFromTheNearerSide() {
        assertThat(SpaceWanderer.steer(ring(1, 0.3)).forwardMps()).isPositive();
        assertThat(SpaceWanderer.steer(ring(2, 0.4, 4, 0.4, 0, 0.5, 7, 1.0))).isEqualTo(new Velocity(0, -0.5));
        assertThat(SpaceWanderer.steer(ring(2, 0.4, 4, 0.4, 0, 1.0, 7, 0.5))).isEqualTo(new Velocity(0, 0.5));
        assertThat(SpaceWanderer.steer(ring(2, 0.5, 5, 0.5)).forwardMps())
                .as("exactly half a metre is not free")
                .isZero();
    }

    // ---- avoid

    private static Avoid.Step avoid(Avoid.Memory memory, double seconds, SonarRing sonar) {
        return AVOID.step(memory, new Senses(seconds, sonar, ORIGIN));
    }

    private static Optional<Velocity> avoided(double... sonarAndRange) {
        return avoid(Avoid.START, 0, ring(sonarAndRange)).velocity();
    }

    @Test
    void avoid_leavesTheRobotToTheLayerBelow_whenNothingIsNear_elseTurnsInPlaceOrSlowsDown() {
        assertThat(avoid(Avoid.START, 0, ring(0, 0.2, 7, 0.2, 3, 0.6)))
                .isEqualTo(new Avoid.Step(Optional.empty(), Avoid.START));
        assertThat(avoided(2, 0.3)).hasValue(new Velocity(0, -0.5));
        assertThat(avoided(5, 0.3)).hasValue(new Velocity(0, 0.5));
        Velocity slow = avoided(4, 0.5).orElseThrow(); // between near and far
        assertThat(slow.forwardMps()).isCloseTo(0.1, within(1e-6)); // half of 0.2 m/s; sonar ranges are floats
        assertThat(slow.turnRadps()).isEqualTo(0.5);
        Avoid.Step first = avoid(Avoid.START, 0, ring(3, 0.3, 4, 0.35)); // a corner, left to one side
        assertThat(avoid(first.memory(), 0, ring(3, 0.35, 4, 0.3))).isEqualTo(first);
    }

    @Test
    void avoid_drivesStraightOn_forAMoment_whenTheWayIsFree() {
        Avoid.Step freed = avoid(new Turning(true), 7, ring());
        assertThat(freed).isEqualTo(new Avoid.Step(Optional.of(new Velocity(0.2, 0)), new Onward(8)));
        assertThat(avoid(freed.memory(), 7.9, ring()).velocity()).isPresent();
        assertThat(avoid(freed.memory(), 8, ring())).isEqualTo(new Avoid.Step(Optional.empty(), Avoid.START));
        assertThat(avoid(freed.memory(), 7.5, ring(3, 0.3)).memory()).isEqualTo(new Turning(false));
    }

    @Test
    void avoidOverGoToGoal_neverDrivesForwardIntoSomethingNearerThanItsThreshold() {
        for (int seed = 0; seed < 100; seed++) {
            var random = new Random(seed);
            double nearM = random.nextDouble(0.21, 1);
            var avoid = new Avoid(nearM, nearM + random.nextDouble(0.01, 1), 0.5, random.nextDouble(3));
            var goal = new GoToGoal(List.of(new Goal(random.nextDouble(-3, 3), 2)), 0.3, 0.1, true);
            Behaviour both = Behaviour.layers(List.of(avoid.behaviour(), goal.behaviour()));
            int held = 0;
            for (int cycle = 0; cycle < 300; cycle++) {
                SonarRing sonar =
                        ring(random.nextInt(8), random.nextDouble(0.1, 2), random.nextInt(8), random.nextDouble(5));
                var pose = new RobotPose(random.nextDouble(-3, 3), random.nextDouble(-3, 3), random.nextDouble(-9, 9));
                var velocity = both.step(new Senses(cycle * 0.1, sonar, pose)).orElse(Velocity.STOP);
                if (IntStream.rangeClosed(1, 6).anyMatch(ahead -> sonar.rangeM(ahead) < nearM)) {
                    held++;
                    assertThat(velocity.forwardMps())
                            .as("seed %d, cycle %d", seed, cycle)
                            .isLessThanOrEqualTo(0);
                }
            }
            assertThat(held).as("seed %d: cycles with something near", seed).isPositive();
        }
    }

    // ---- go to goal

    private static GoToGoal to(Goal... goals) {
        return new GoToGoal(List.of(goals), 0.3, 0.1, false);
    }

    private static Velocity velocity(GoToGoal law, RobotPose pose) {
        return law.step(0, pose).velocity().orElseThrow();
    }

    @Test
    void goal_isDrivenTo_inProportionToTheDistance_andTurnedTo_slowerTheFartherItIsAside() {
        assertThat(velocity(to(EAST), ORIGIN)).isEqualTo(new Velocity(0.3, 0));
        assertThat(velocity(to(EAST), new RobotPose(1.8, 0, 0)).forwardMps()).isCloseTo(0.2, within(1e-12));
        Velocity left = velocity(to(new Goal(1, 1)), ORIGIN);
        assertThat(left.forwardMps()).isCloseTo(0.3 * Math.cos(Math.PI / 4), within(1e-12));
        assertThat(left.turnRadps()).isEqualTo(0.8); // 1.5 * pi / 4 would be more
        Velocity right = velocity(to(EAST), new RobotPose(0, 0, 0.2));
        assertThat(right.turnRadps()).isCloseTo(-0.3, within(1e-12));
        Velocity behind = velocity(to(new Goal(-1, 0.1)), new RobotPose(0, 0, -3));
        assertThat(behind.forwardMps()).isPositive(); // the goal is almost in front: the angle wraps at pi
        assertThat(behind.turnRadps()).isNegative();
        assertThat(velocity(to(EAST), new RobotPose(0, 0, 3)).forwardMps()).isZero();
    }

    @Test
    void goals_areVisitedInTurn_andAgainWhenAsked_theLastLeavesNothingToSay() {
        GoToGoal.Step there = to(EAST).step(0, new RobotPose(1.95, 0, 1));
        assertThat(there).isEqualTo(new GoToGoal.Step(Optional.empty(), 0));
        var moved = new RobotPose(1.5, 0, 0);
        assertThat(to(EAST).step(there.goal(), moved).velocity()).isPresent();
        GoToGoal.Step first = to(EAST, NORTH).step(0, new RobotPose(2, 0, Math.PI / 2));
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
        assertThatThrownBy(() -> new Avoid(0, 0.5, 0.5, 1)).hasMessageContaining("turns in place is 0.0 m");
        assertThatThrownBy(() -> new Avoid(0.5, 0.5, 0.5, 1)).hasMessageContaining("more than the 0.5 m");
        assertThatThrownBy(() -> new Avoid(0.5, 6, 0.5, 1)).hasMessageContaining("at most 5.0 m");
        assertThatThrownBy(() -> new Avoid(0.5, 0.6, 0, 1)).hasMessageContaining("0.0 rad/s");
        assertThatThrownBy(() -> new Avoid(0.5, 0.6, 1, -1)).hasMessageContaining("-1.0 s");
        assertThatThrownBy(() -> to()).hasMessage("a way of 0 goals, expected 1 or more");
        assertThatThrownBy(() -> to(new Goal(Double.NaN, 0))).hasMessageContaining("expected finite metres");
        assertThatThrownBy(() -> new GoToGoal(List.of(EAST), 0, 0.1, false))
                .hasMessage("the speed is 0.0 m/s, expected more than 0");
        assertThatThrownBy(() -> new GoToGoal(List.of(EAST), 0.3, -1, false)).hasMessageContaining("-1.0 m");
    }
}
