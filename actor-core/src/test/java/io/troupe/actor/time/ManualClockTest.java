package io.troupe.actor.time;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class ManualClockTest {
    private final ManualClock clock = new ManualClock();
    private final int[] moves = new int[1];

    @Test
    void advanceTo_whatIsOver_isRefused() {
        clock.advanceTo(20);
        assertThatThrownBy(() -> clock.advanceTo(10)).hasMessageContaining("a clock does not go back: from 20 ns");
        assertThat(clock.nanos()).isEqualTo(20);
    }

    @Test
    void advanceToAtLeast_movesForwardOnly_andTellsOfMovesOnly() {
        clock.onMove(() -> moves[0]++);
        clock.advanceToAtLeast(20);
        clock.advanceToAtLeast(10);
        clock.advanceToAtLeast(20);
        assertThat(clock.nanos()).isEqualTo(20);
        assertThat(moves[0]).isEqualTo(1);
    }
}
