package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.HashSet;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class FourSendersTest {
    private final Subject.FourSenders four = new Subject.FourSenders();

    @AfterEach
    void close() {
        four.close();
    }

    /** Repeated many times: without the barrier a thread sends two shares only now and then. */
    @Test
    void everyTurn_hasAShareForEachOfTheSameFourThreads() throws Exception {
        Set<Thread> kept = new HashSet<>();
        for (int turn = 0; turn < 300; turn++) {
            var shares = new ConcurrentHashMap<Thread, Integer>();
            four.send(11, share -> shares.merge(Thread.currentThread(), share, Integer::sum));
            assertThat(shares.values()).containsExactlyInAnyOrder(3, 3, 3, 2);
            kept.addAll(shares.keySet());
        }
        assertThat(kept).hasSize(4);
    }

    @Test
    void failingSender_failsTheTurn() {
        var failure = new IllegalStateException("full");
        assertThatThrownBy(() -> four.send(4, share -> {
                    throw failure;
                }))
                .isInstanceOf(ExecutionException.class)
                .hasCause(failure);
    }
}
