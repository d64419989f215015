package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import java.util.OptionalLong;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.FutureTask;
import org.junit.jupiter.api.Test;

/** How old frames are, and how many values are missing, by what a node knows of others. */
class RemotePublishersTest {
    private static final Duration MINUTE = Duration.ofMinutes(1);

    private static final long SECOND_NANOS = 1_000_000_000;
    private static final long AFTER_THE_OPENING = 1; // nanoseconds on the subscriber's clock

    private final RemotePublishers publishers = new RemotePublishers();

    private static Frames.Header header(String node, Duration sent) {
        return header(node, 1, sent);
    }

    private static Frames.Header header(String node, long incarnation, Duration sent) {
        return new Frames.Header(new Address(node, "a"), incarnation, 1, sent.toNanos() / 1_000);
    }

    private long ageMillis(String node, Duration sent, Duration arrived) {
        return publishers.ageNanos(header(node, sent), arrived.toNanos()) / 1_000_000;
    }

    /** The age of a frame that arrives that long after it was sent, by clocks that differ. */
    private long ageMillis(Duration sent, long delayMillis) {
        return ageMillis("far", sent, sent.plusHours(5).plusMillis(delayMillis));
    }

    @Test
    void age_isTheDelayBeyondThatOfTheFastestFrame() {
        assertThat(ageMillis(Duration.ZERO, 7)).isZero();
        assertThat(ageMillis(Duration.ofSeconds(1), 10)).isEqualTo(3);
        assertThat(ageMillis(Duration.ofSeconds(2), 2)).isZero();
        assertThat(ageMillis(Duration.ofSeconds(3), 10)).isEqualTo(8);
    }

    @Test
    void fastestFrame_isForgottenAfterAMinuteOrTwo_becauseClocksDrift() {
        assertThat(ageMillis(Duration.ZERO, 0)).isZero();
        assertThat(ageMillis(MINUTE.plusMillis(1), 200)).as("of this minute").isEqualTo(200);
        assertThat(ageMillis(MINUTE.plusSeconds(1), 100)).isEqualTo(100);
        assertThat(ageMillis(MINUTE.plusSeconds(2), 150)).isEqualTo(150);
        assertThat(ageMillis(MINUTE.multipliedBy(2).plusSeconds(1), 300))
                .as("100 ms is the usual delay by now")
                .isEqualTo(200);
    }

    @Test
    void gap_isCountedOnce_andALateValueIsNone() {
        var far = header("far", Duration.ZERO);
        publishers.ageNanos(far, 0); // "far" was opened at 0
        assertThat(publishers.missing(far, "t", 5, AFTER_THE_OPENING)).isZero();
        assertThat(publishers.missing(far, "t", 8, AFTER_THE_OPENING)).isEqualTo(2);
        assertThat(publishers.missing(far, "t", 7, AFTER_THE_OPENING)).isZero();
        publishers.missing(far, "u", 1, AFTER_THE_OPENING);
        publishers.forget("t");
        assertThat(publishers.missing(far, "t", 20, AFTER_THE_OPENING)).isZero();
        assertThat(publishers.missing(far, "u", 3, AFTER_THE_OPENING)).isEqualTo(1);
    }

    @Test
    void firstValue_isMissing_onlyIfItsNodeWasOpenedAfterTheSubscription() {
        var far = header("far", Duration.ZERO);
        publishers.ageNanos(far, 0);
        assertThat(publishers.missing(far, "t", 5, -1)).isEqualTo(4);
        assertThat(publishers.missing(far, "u", 5, 0)).isZero();
    }

    private long missingAtMark(String topic, long last, long begunNanos, long subscribedNanos) {
        var far = header("far", MINUTE);
        return publishers.missingAtMark(far, topic, last, OptionalLong.of(begunNanos / 1_000), subscribedNanos);
    }

    @Test
    void valuesBeforeTheFirst_areMissing_onceAMarkShowsThatTheyFollowedTheSubscription() {
        var far = header("far", MINUTE);
        long subscribedNanos = SECOND_NANOS;
        publishers.ageNanos(far, MINUTE.toNanos()); // "far" was opened at 0
        assertThat(publishers.missing(far, "t", 5, subscribedNanos)).isZero();
        assertThat(publishers.missingAtMark(far, "t", 6, OptionalLong.empty(), subscribedNanos))
                .as("a mark of a small node shows only the last value")
                .isEqualTo(1);
        assertThat(missingAtMark("t", 8, 2 * SECOND_NANOS, subscribedNanos))
                .as("4 before the first, and 2 after the last")
                .isEqualTo(6);
        assertThat(missingAtMark("t", 8, 2 * SECOND_NANOS, subscribedNanos)).isZero();
        assertThat(publishers.missing(far, "t", 9, subscribedNanos)).isZero();
    }

    @Test
    void valuesOfASeriesThatBeganBeforeTheSubscription_areNotMissing() {
        var far = header("far", MINUTE);
        publishers.ageNanos(far, MINUTE.toNanos());
        assertThat(publishers.missing(far, "t", 5, SECOND_NANOS)).isZero();
        assertThat(missingAtMark("t", 5, SECOND_NANOS, SECOND_NANOS)).isZero();
        assertThat(missingAtMark("t", 5, 2 * SECOND_NANOS, SECOND_NANOS))
                .as("decided by the first mark")
                .isZero();
    }

    @Test
    void seriesOfWhichOnlyAMarkArrives_isMissingAsAWhole_ifItBeganAfterTheSubscription() {
        publishers.ageNanos(header("far", MINUTE), MINUTE.toNanos());
        assertThat(missingAtMark("t", 1, 2 * SECOND_NANOS, SECOND_NANOS)).isEqualTo(1);
        assertThat(missingAtMark("u", 3, 0, SECOND_NANOS)).isZero();
    }

    @Test
    void markOfALaterSeriesOfThePort_saysNothingOfTheFirstValuesOfTheEarlierOne() {
        var far = header("far", MINUTE);
        publishers.ageNanos(far, MINUTE.toNanos());
        assertThat(publishers.missing(far, "t", 5, SECOND_NANOS)).isZero();
        assertThat(missingAtMark("t", 1, MINUTE.toNanos() + SECOND_NANOS, SECOND_NANOS))
                .isZero();
    }

    @Test
    void memory_doesNotGrowWithTheNamesThatOthersInvent() {
        var far = header("far", Duration.ZERO);
        publishers.ageNanos(far, 0); // "far" was opened at 0
        for (int i = 0; i <= 10_000; i++) {
            publishers.missing(far, "topic" + i, 1, AFTER_THE_OPENING);
        }
        assertThat(publishers.missing(far, "topic0", 9, AFTER_THE_OPENING))
                .as("forgotten")
                .isZero();
        assertThat(publishers.missing(far, "topic10000", 9, AFTER_THE_OPENING)).isEqualTo(7);
        for (int i = 0; i <= 10_000; i++) {
            ageMillis("node" + i, Duration.ZERO, Duration.ZERO);
        }
        assertThat(ageMillis("node0", Duration.ZERO, MINUTE)).as("forgotten").isZero();
        assertThat(ageMillis("node10000", Duration.ZERO, MINUTE)).isEqualTo(60_000);
    }

    @Test
    void lateFramesOfALifeBefore_changeNothingInTheNext() {
        var late = header("far", 1, MINUTE);
        var next = header("far", 2, Duration.ZERO);
        publishers.ageNanos(late, MINUTE.toNanos());
        assertThat(publishers.missing(late, "t", 8, -1)).isEqualTo(7);
        for (int number = 1; number < 10; number++) {
            publishers.ageNanos(next, MINUTE.toNanos());
            assertThat(publishers.missing(next, "t", number, -1)).isZero();
            publishers.ageNanos(late, MINUTE.toNanos());
            assertThat(publishers.missing(late, "t", 8 + number, -1)).isZero();
        }
        publishers.forget("t");
        assertThat(publishers.isFirst(next, "t")).isTrue();
        assertThat(publishers.isFirst(late, "t")).isTrue();
    }

    @Test
    void firstFramesOfANode_onTwoThreads_areThoseOfOneLife() throws Exception {
        for (int i = 0; i < 2_000; i++) {
            var far = header("far " + i, Duration.ZERO);
            var barrier = new CyclicBarrier(2);
            var other = new FutureTask<>(() -> {
                barrier.await();
                return publishers.ageNanos(far, 0);
            });
            Thread.ofPlatform().start(other);
            barrier.await();
            publishers.missing(far, "t", 1, -1);
            other.get();
            assertThat(publishers.missing(far, "t", 2, -1)).isZero();
        }
    }
}
