package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

class ContenderProcessTest {
    private static final int BYTES = 10_000;

    private final List<byte[]> kept = new ArrayList<>();

    /** Also produces as much garbage; large, so that garbage of other tests in this JVM does not matter. */
    private void create() {
        for (int i = 0; i < ContenderProcess.RetainedHeap.ACTORS; i++) {
            kept.add(new byte[BYTES]);
            kept.set(i, kept.get(i).clone());
        }
    }

    @Test
    void bytesPerActor_areThoseThatAreKept() throws Exception {
        assertThat(ContenderProcess.RetainedHeap.bytesPerActor(this::create, kept::clear))
                .isBetween(0.9 * BYTES, 1.1 * BYTES);
    }
}
