package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;

class IdleStrategyTest {
    @Test
    void runningSpace_whoseWakerCouldNotUnparkIt_isNotTakenForAsleep_andIsWokenAgain() {
        var lifeline = new IdleStrategy();
        lifeline.noteNotWoken();
        assertThat(lifeline.isAsleep()).isFalse();
        assertThat(lifeline.wake()).isTrue();
        assertThat(lifeline.phase).isZero();
        lifeline.close();
        lifeline.noteNotWoken();
        assertThat(lifeline.isClosed()).isTrue();
    }
}
