package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Nested;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** What contenders do, and what is measured of them. */
class ContendersTest {
    /** A lost message makes its workload wait for ever, which the time limit detects. */
    @Nested
    @Timeout(value = 60, unit = TimeUnit.SECONDS, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
    class Workloads {
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

    @Test
    void wholeTellOfMany_isAMultipleOfItsTypes() {
        assertThat(List.of(1, 200, 201))
                .extracting(Workload.TELL_OF_MANY::whole)
                .containsExactly(200, 200, 400);
        assertThat(Workload.TELL.whole(7)).isEqualTo(7);
    }

    @Test
    void wakeUps_areNotRanked() {
        assertThat(Arrays.stream(Workload.values()).filter(each -> !each.isRanked()))
                .containsExactly(Workload.ASK_ONCE, Workload.ASK_AFTER_SILENCE);
    }

    @Test
    void lineOfATurn_isParsedToTheSameTurn_andOneWithoutBytesIsNamed() {
        var turn = new TurnResult(1.0 / 3, 1e12);
        assertThat(TurnResult.parse(turn.line())).isEqualTo(turn);
        assertThatThrownBy(() -> TurnResult.parse("15.7"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a turn is \"15.7\", expected nanoseconds and bytes per operation");
    }

    @Test
    void allocatedBytes_growByWhatWasAllocated() {
        long before = TurnResult.allocatedBytes();
        var garbage = new byte[1_000_000];
        assertThat(TurnResult.allocatedBytes() - before).isGreaterThanOrEqualTo(garbage.length);
    }

    /** Produces as much garbage as is kept; large, so that garbage of other tests in this JVM does not matter. */
    @Test
    void bytesPerActor_areThoseThatAreKept() throws Exception {
        int bytes = 10_000;
        List<byte[]> kept = new ArrayList<>();
        Runnable create = () -> {
            for (int i = 0; i < ContenderProcess.RetainedHeap.ACTORS; i++) {
                kept.add(new byte[bytes]);
                kept.set(i, kept.get(i).clone());
            }
        };
        assertThat(ContenderProcess.RetainedHeap.bytesPerActor(create::run, kept::clear))
                .isBetween(0.9 * bytes, 1.1 * bytes);
    }

    /** Repeated many times: without the barrier a thread sends two shares only now and then. */
    @Test
    void everyTurnOfFourSenders_hasAShareForEachOfTheSameFourThreads() throws Exception {
        Set<Thread> kept = new HashSet<>();
        try (var four = new Subject.FourSenders()) {
            for (int turn = 0; turn < 300; turn++) {
                var shares = new ConcurrentHashMap<Thread, Integer>();
                four.send(11, share -> shares.merge(Thread.currentThread(), share, Integer::sum));
                assertThat(shares.values()).containsExactlyInAnyOrder(3, 3, 3, 2);
                kept.addAll(shares.keySet());
            }
        }
        assertThat(kept).hasSize(4);
    }

    @Test
    void failingSender_failsTheTurn() {
        var failure = new IllegalStateException("full");
        try (var four = new Subject.FourSenders()) {
            assertThatThrownBy(() -> four.send(4, share -> {
                        throw failure;
                    }))
                    .isInstanceOf(ExecutionException.class)
                    .hasCause(failure);
        }
    }
}
