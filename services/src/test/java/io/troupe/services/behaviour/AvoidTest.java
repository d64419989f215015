package io.troupe.services.behaviour;

import static io.troupe.services.behaviour.SonarRingTest.ring;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.services.behaviour.Avoid.Memory;
import io.troupe.services.behaviour.Avoid.Step;
import io.troupe.services.behaviour.GoToGoal.Goal;
import java.util.List;
import java.util.Optional;
import java.util.Random;
import org.junit.jupiter.api.Test;

class AvoidTest {
    private static final Avoid AVOID = new Avoid(0.4, 0.6, 0.5, 1);

    private static Senses senses(double seconds, SonarRing sonar) {
        return new Senses(seconds, sonar, new RobotPose(0, 0, 0));
    }

    private static Step step(Memory memory, SonarRing sonar) {
        return AVOID.step(memory, senses(0, sonar));
    }

    @Test
    void nothingNear_leavesTheRobotToTheLayerBelow() {
        assertThat(step(Avoid.START, ring(0, 0.2, 7, 0.2, 3, 0.6))).isEqualTo(new Step(Optional.empty(), Avoid.START));
    }

    @Test
    void somethingNearer_turnsInPlace_awayFromIt() {
        assertThat(step(Avoid.START, ring(2, 0.3)).velocity()).hasValue(new Velocity(0, -0.5));
        assertThat(step(Avoid.START, ring(5, 0.3)).velocity()).hasValue(new Velocity(0, 0.5));
    }

    @Test
    void somethingBetweenNearAndFar_slowsDownInProportion() {
        Velocity slow = step(Avoid.START, ring(4, 0.5)).velocity().orElseThrow();
        assertThat(slow.forwardMps()).isCloseTo(0.1, within(1e-6)); // half of 0.2 m/s; sonar ranges are floats
        assertThat(slow.turnRadps()).isEqualTo(0.5);
    }

    @Test
    void corner_isLeftToOneSide() {
        Step first = step(Avoid.START, ring(3, 0.3, 4, 0.35));
        Step second = step(first.memory(), ring(3, 0.35, 4, 0.3));
        assertThat(second).isEqualTo(first);
    }

    @Test
    void freeWay_isDrivenStraightOn_forAMoment() {
        Step freed = AVOID.step(new Memory.Turning(true), senses(7, ring()));
        assertThat(freed).isEqualTo(new Step(Optional.of(new Velocity(0.2, 0)), new Memory.Onward(8)));
        assertThat(AVOID.step(freed.memory(), senses(7.9, ring())).velocity()).isPresent();
        assertThat(AVOID.step(freed.memory(), senses(8, ring()))).isEqualTo(new Step(Optional.empty(), Avoid.START));
        assertThat(AVOID.step(freed.memory(), senses(7.5, ring(3, 0.3))).memory())
                .isEqualTo(new Memory.Turning(false));
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
                Velocity velocity =
                        both.step(new Senses(cycle * 0.1, sonar, pose)).orElse(Velocity.STOP);
                boolean near = false;
                for (int ahead = 1; ahead <= 6; ahead++) {
                    near |= sonar.rangeM(ahead) < nearM;
                }
                if (near) {
                    held++;
                    assertThat(velocity.forwardMps())
                            .as("seed %d, cycle %d", seed, cycle)
                            .isLessThanOrEqualTo(0);
                }
            }
            assertThat(held).as("seed %d: cycles with something near", seed).isPositive();
        }
    }

    @Test
    void numbersThatMakeNoSense_areRefused() {
        assertThatThrownBy(() -> new Avoid(0, 0.5, 0.5, 1)).hasMessageContaining("turns in place is 0.0 m");
        assertThatThrownBy(() -> new Avoid(0.5, 0.5, 0.5, 1)).hasMessageContaining("more than the 0.5 m");
        assertThatThrownBy(() -> new Avoid(0.5, 6, 0.5, 1)).hasMessageContaining("at most 5.0 m");
        assertThatThrownBy(() -> new Avoid(0.5, 0.6, 0, 1)).hasMessageContaining("0.0 rad/s");
        assertThatThrownBy(() -> new Avoid(0.5, 0.6, 1, -1)).hasMessageContaining("-1.0 s");
    }
}
