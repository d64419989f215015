package io.troupe.services.bus;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;

/** The contract between two nodes that exchange bytes. */
class TwoNodesContractTest extends BusContract {
    private final BytePipe pipe = new BytePipe(test.space());
    private final BusNode near = pipe.open("near", settings());
    private final BusNode far = pipe.open("far", settings());

    @Override
    Bus near() {
        return near;
    }

    @Override
    Bus far() {
        return far;
    }

    @Override
    BusMetrics nearMetrics() {
        return near.metrics();
    }

    @Override
    BusMetrics farMetrics() {
        return far.metrics();
    }

    @Override
    void arrive() {
        pipe.carryAll();
    }

    @Test
    void messages_goAsBytes() {
        near.attach("a").publish(COUNTS, new Count(1));
        test.crank();
        assertThat(pipe.bytesCarried()).isPositive();
    }
}
