package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Arrays;
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
}
