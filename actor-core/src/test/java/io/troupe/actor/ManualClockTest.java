package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static io.troupe.actor.Concurrently.onThreads;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.time.Duration;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class ManualClockTest {
    private final ManualClock clock = new ManualClock();

    @Test
    void advance_toWhatIsOver_orByANegativeDuration_isRejected() {
        clock.advanceTo(20);
        assertThatThrownBy(() -> clock.advanceTo(10)).hasMessageContaining("a clock does not go back: from 20 ns");
        assertThatThrownBy(() -> clock.advance(Duration.ofNanos(-1)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("does not go back");
        assertThat(clock.nanos()).isEqualTo(20);
    }

    @Test
    void advanceToAtLeast_movesForwardOnly_andNotifiesOfMovesOnly() {
        var moves = new AtomicInteger();
        clock.onMove(moves::incrementAndGet);
        clock.advanceToAtLeast(20);
        clock.advanceToAtLeast(10);
        clock.advanceToAtLeast(20);
        assertThat(clock.nanos()).isEqualTo(20);
        assertThat(moves).hasValue(1);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void advance_bySeveralThreadsAtOnce_countsEachMove() {
        int moversMoves = 50_000;
        onThreads(4, mover -> {
            for (int move = 0; move < moversMoves; move++) {
                clock.advance(Duration.ofNanos(1));
            }
        });
        assertThat(clock.nanos()).isEqualTo(4L * moversMoves);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void severalSpaces_onOneClock_eachRunTheirTimers() throws Exception {
        try (var one = ActorSpace.create(SpaceSettings.named("one").withClock(clock));
                var other = ActorSpace.create(SpaceSettings.named("other").withClock(clock))) {
            Promise<?> short1 = one.delay(Duration.ofMillis(10));
            Promise<?> short2 = other.delay(Duration.ofMillis(10));
            Promise<?> longer = other.delay(Duration.ofMillis(11));
            clock.advance(Duration.ofMillis(10));
            short1.get(LONG);
            short2.get(LONG);
            assertThat(longer.isDone()).isFalse();
            clock.advance(Duration.ofMillis(1));
            longer.get(LONG);
        }
    }
}
