package io.troupe.services.behaviour;

import static io.troupe.services.behaviour.SonarRingTest.ring;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.behaviour.WallFollower.Memory;
import io.troupe.services.behaviour.WallFollower.Step;
import org.junit.jupiter.api.Test;

/** Tables 1 and 2 of the paper, row by row. */
class WallFollowerTest {
    private final WallFollower follower = new WallFollower(CornerStyle.FORWARD);

    @Test
    void table1Row1_nothingNear_drivesForward() {
        assertThat(follower.step(WallFollower.START, ring()))
                .isEqualTo(new Step(new Velocity(0.2, 0), WallFollower.START));
    }

    @Test
    void table1Row2_wallAhead_turnsRightFast() {
        Step step = follower.step(WallFollower.START, ring(3, 0.35));
        assertThat(step).isEqualTo(new Step(new Velocity(0, -0.45), new Memory.Aligning(5.0)));
        Step next = follower.step(step.memory(), ring(3, 0.35, 0, 1.0));
        assertThat(next).isEqualTo(new Step(new Velocity(0, -0.45), new Memory.Aligning(1.0)));
    }

    @Test
    void table1Row3_wallOnTheLeftNearerThanAhead_turnsRightSlowly() {
        Step step = follower.step(WallFollower.START, ring(2, 0.35));
        assertThat(step).isEqualTo(new Step(new Velocity(0, -0.15), new Memory.Aligning(5.0)));
    }

    @Test
    void alignment_endsWhenTheLeftReadingGrows() {
        Step same = follower.step(new Memory.Aligning(0.5), ring(0, 0.5));
        assertThat(same.memory()).isEqualTo(new Memory.Aligning(0.5));
        Step grown = follower.step(new Memory.Aligning(0.5), ring(0, 0.51));
        assertThat(grown).isEqualTo(new Step(Velocity.STOP, new Memory.Following()));
    }

    @Test
    void table2Row1_wallAhead_turnsRight_asThePaperOrAsItsModel() {
        SonarRing ahead = ring(4, 0.39, 0, 0.35);
        assertThat(follow(follower, ahead)).isEqualTo(new Velocity(0.1, -0.6));
        assertThat(follow(new WallFollower(CornerStyle.BACKWARD), ahead)).isEqualTo(new Velocity(-0.1, -0.6));
    }

    @Test
    void table2Row2_wallTooNear_turnsAway() {
        assertThat(follow(follower, ring(0, 0.29))).isEqualTo(new Velocity(0.1, -0.15));
    }

    @Test
    void table2Row3_wallTooFar_turnsTowardsIt() {
        assertThat(follow(follower, ring(0, 0.41))).isEqualTo(new Velocity(0.1, 0.15));
    }

    @Test
    void table2Row4_wallAtTheRightDistance_drivesForward() {
        assertThat(follow(follower, ring(0, 0.35))).isEqualTo(new Velocity(0.2, 0));
    }

    @Test
    void table2_upperRowsHavePriority() {
        assertThat(follow(follower, ring(3, 0.3, 0, 0.25))).isEqualTo(new Velocity(0.1, -0.6));
    }

    private static Velocity follow(WallFollower follower, SonarRing ring) {
        Step step = follower.step(new Memory.Following(), ring);
        assertThat(step.memory()).isEqualTo(new Memory.Following());
        return step.velocity();
    }
}
