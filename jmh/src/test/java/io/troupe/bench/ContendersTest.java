package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Collections;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** A lost message makes its workload wait for ever, which the time limit detects. */
@Timeout(value = 10, unit = TimeUnit.SECONDS, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class ContendersTest {
    private static final int ROUNDS = 3;

    @ParameterizedTest
    @EnumSource
    void everyWorkload_endsAndIsMeasured(Contenders contender) throws Exception {
        try (var subject = new Subject(contender.start())) {
            subject.contender().wake();
            for (Workload workload : Workload.values()) {
                TurnResult turn = workload.run(subject, workload == Workload.ASK_AFTER_SILENCE ? 1 : 30);
                assertThat(turn.nanos()).as(workload.label()).isPositive();
                assertThat(turn.bytes()).as(workload.label()).isNotNegative();
            }
        }
    }

    @ParameterizedTest
    @EnumSource
    void tellOfMany_reachesEachMessageTypeInItsOwnWay(Contenders contender) throws Exception {
        try (var subject = new Subject(contender.start())) {
            subject.contender().wake();
            subject.tellOfMany(ROUNDS * Families.TYPES);
            var families = subject.families();
            assertThat(families.all()).extracting(Object::getClass).doesNotHaveDuplicates();
            // type k of 1..10 adds k times 0, 1 and 2
            assertThat(families.sums())
                    .isEqualTo(Collections.nCopies(Families.TYPES / Family.TYPES, 55L * (0 + 1 + 2)));
        }
    }
}
