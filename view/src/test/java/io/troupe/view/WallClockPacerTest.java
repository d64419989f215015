package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;

class WallClockPacerTest {
    @Test
    void await_endsNoEarlierThanTheSimulatedTime_fromTheBeginning() {
        long began = System.nanoTime();
        var pacer = new WallClockPacer();
        pacer.await(1_000);
        assertThat(System.nanoTime() - began).isGreaterThanOrEqualTo(1_000_000);
        pacer.await(3_000);
        assertThat(System.nanoTime() - began).isGreaterThanOrEqualTo(3_000_000);
        pacer.await(0); // already over
    }
}
