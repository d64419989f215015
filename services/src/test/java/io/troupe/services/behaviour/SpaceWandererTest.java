package io.troupe.services.behaviour;

import static io.troupe.services.behaviour.SonarRingTest.ring;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import org.junit.jupiter.api.Test;

class SpaceWandererTest {
    @Test
    void openSpace_drivesStraightAtFullSpeed() {
        assertThat(SpaceWanderer.steer(ring())).isEqualTo(new Velocity(0.5, 0));
    }

    @Test
    void moreRoomOnTheLeft_turnsLeft_byThePapersFormula() {
        Velocity velocity = SpaceWanderer.steer(ring(5, 1.0, 6, 3.0)); // left (5 + 5)/2, right (1 + 3)/2
        assertThat(velocity.forwardMps()).isCloseTo((0.5 + 0.2) / 2, within(1e-12));
        assertThat(velocity.turnRadps()).isCloseTo((0.5 - 0.2) * 57.29577951308232 / 24, within(1e-12));
    }

    @Test
    void freeOnOneSide_isEnoughToDriveOn() {
        assertThat(SpaceWanderer.steer(ring(1, 0.3)).forwardMps()).isPositive();
    }

    @Test
    void nothingFree_turnsAwayFromTheNearerSide() {
        assertThat(SpaceWanderer.steer(ring(2, 0.4, 4, 0.4, 0, 0.5, 7, 1.0))).isEqualTo(new Velocity(0, -0.5));
        assertThat(SpaceWanderer.steer(ring(2, 0.4, 4, 0.4, 0, 1.0, 7, 0.5))).isEqualTo(new Velocity(0, 0.5));
    }

    @Test
    void exactlyHalfAMetre_isNotFree() {
        assertThat(SpaceWanderer.steer(ring(2, 0.5, 5, 0.5)).forwardMps()).isZero();
    }
}
