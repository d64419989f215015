package io.troupe.common.measure;

import static org.assertj.core.api.Assertions.assertThat;

import java.lang.ref.Reference;
import java.time.Duration;
import org.junit.jupiter.api.Test;

class UsedHeapTest {
    private static final int BYTES = 16 << 20;

    @Test
    void bytes_countWhatIsKept_andNoGarbage() throws InterruptedException {
        long before = UsedHeap.bytes();
        var kept = new byte[BYTES];
        var garbage = kept.clone();
        assertThat(garbage).hasSize(BYTES);
        garbage = null;
        assertThat(UsedHeap.bytes() - before).isBetween((long) (0.9 * BYTES), (long) (1.5 * BYTES));
        assertThat(UsedHeap.bytes(Duration.ofMillis(1)) - before).isBetween((long) (0.9 * BYTES), (long) (1.5 * BYTES));
        Reference.reachabilityFence(kept);
    }
}
