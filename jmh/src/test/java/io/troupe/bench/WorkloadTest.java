package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Arrays;
import java.util.Collections;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;

class WorkloadTest {
    @Test
    void wholeTellOfMany_isAMultipleOfItsTypes() {
        assertThat(Workload.TELL_OF_MANY.whole(1)).isEqualTo(200);
        assertThat(Workload.TELL_OF_MANY.whole(200)).isEqualTo(200);
        assertThat(Workload.TELL_OF_MANY.whole(201)).isEqualTo(400);
        assertThat(Workload.TELL.whole(7)).isEqualTo(7);
    }

    @Test
    void wakeUps_areNotRanked() {
        assertThat(Arrays.stream(Workload.values()).filter(each -> !each.isRanked()))
                .containsExactly(Workload.ASK_ONCE, Workload.ASK_AFTER_SILENCE);
    }

    @Test
    void fourSenders_sendAllTogetherOnFourThreads_eachTime() throws Exception {
        Set<Thread> threads = Collections.newSetFromMap(new ConcurrentHashMap<>());
        var sent = new AtomicInteger();
        try (var four = new FourSenders()) {
            for (int i = 0; i < 3; i++) {
                four.send(11, share -> {
                    threads.add(Thread.currentThread());
                    sent.addAndGet(share);
                });
            }
        }
        assertThat(sent).hasValue(33);
        assertThat(threads).hasSize(4);
    }
}
