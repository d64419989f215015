package io.troupe.actor.time;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

class TimerWheelTest {
    private static final long MILLI = 1_000_000;

    private final ManualClock clock = new ManualClock();
    private final TimerWheel wheel = new TimerWheel(clock);
    private final List<String> log = new ArrayList<>();

    private void advanceMillis(long millis) {
        clock.advance(Duration.ofMillis(millis));
        while (wheel.isDue()) {
            wheel.runDue(Runnable::run);
        }
    }

    @Test
    void timer_runsAtItsDeadlineAndNotBefore() {
        wheel.set(() -> log.add("ring"), 5 * MILLI, 0);
        advanceMillis(4);
        assertThat(log).isEmpty();
        assertThat(wheel.isDue()).isFalse();
        advanceMillis(1);
        assertThat(log).containsExactly("ring");
        assertThat(wheel.isEmpty()).isTrue();
    }

    @Test
    void timers_runByDeadlineThenByTheOrderInWhichTheyWereSet() {
        wheel.set(() -> log.add("b"), 2 * MILLI + 500, 0);
        wheel.set(() -> log.add("a"), 2 * MILLI + 499, 0);
        wheel.set(() -> log.add("c"), 2 * MILLI + 500, 0);
        advanceMillis(3);
        assertThat(log).containsExactly("a", "b", "c");
    }

    @Test
    void timer_beyondOneRound_waitsForItsRound() {
        wheel.set(() -> log.add("late"), 1_000 * MILLI, 0);
        wheel.set(() -> log.add("early"), 488 * MILLI, 0); // the same slot, one round before
        advanceMillis(600);
        assertThat(log).containsExactly("early");
        advanceMillis(399);
        assertThat(log).containsExactly("early");
        advanceMillis(1);
        assertThat(log).containsExactly("early", "late");
    }

    @Test
    void periodicTimer_runsOncePerPeriodThatIsOver_untilCancelled() {
        Timer timer = wheel.set(() -> log.add("tick"), 100 * MILLI, 100 * MILLI);
        advanceMillis(1_050);
        assertThat(log).hasSize(10);
        assertThat(timer.cancel()).isTrue();
        assertThat(timer.cancel()).isFalse();
        advanceMillis(1_000);
        assertThat(log).hasSize(10);
    }

    @Test
    void periodicTimer_thatIsLate_letsOthersHaveTheirTurn() {
        wheel.set(() -> log.add("fast"), MILLI, MILLI);
        clock.advance(Duration.ofMillis(10));
        assertThat(wheel.runDue(Runnable::run)).isEqualTo(1);
        assertThat(wheel.isDue()).isTrue();
        wheel.set(() -> log.add("other"), 0, 0);
        assertThat(wheel.runDue(Runnable::run)).isEqualTo(2);
        assertThat(log).containsExactly("fast", "fast", "other");
    }

    @Test
    void timerForTheEndOfTime_waits() {
        wheel.set(() -> log.add("never"), Long.MAX_VALUE, 0);
        advanceMillis(10_000);
        assertThat(log).isEmpty();
    }

    @Test
    void timerCancelledByAnEarlierOne_doesNotRun() {
        var second = new Timer[1];
        wheel.set(() -> second[0].cancel(), MILLI, 0);
        second[0] = wheel.set(() -> log.add("never"), 2 * MILLI, 0);
        advanceMillis(5);
        assertThat(log).isEmpty();
    }

    @Test
    void negativePeriod_isRefused() {
        assertThatThrownBy(() -> wheel.set(() -> {}, 0, -1)).hasMessageContaining("-1 ns");
    }

    @Test
    void randomTimers_runExactlyAsASortedListWould() {
        for (long seed = 1; seed <= 50; seed++) {
            var random = new Random(seed);
            var myClock = new ManualClock();
            var myWheel = new TimerWheel(myClock);
            record Due(long deadline, int number) {}
            var expected = new ArrayList<Due>();
            var actual = new ArrayList<Integer>();
            int number = 0;
            for (int round = 0; round < 40; round++) {
                for (int i = random.nextInt(4); i > 0; i--) {
                    int id = number++;
                    long delay = random.nextLong(3_000 * MILLI);
                    expected.add(new Due(myClock.nanos() + delay, id));
                    Timer timer = myWheel.set(() -> actual.add(id), delay, 0);
                    if (random.nextInt(5) == 0) {
                        timer.cancel();
                        expected.removeLast();
                    }
                }
                assertThat(myWheel.nextDeadline())
                        .as("seed %d", seed)
                        .isLessThanOrEqualTo(expected.stream()
                                .filter(due -> !actual.contains(due.number))
                                .mapToLong(Due::deadline)
                                .min()
                                .orElse(Long.MAX_VALUE));
                myClock.advanceTo(myClock.nanos() + random.nextLong(1_000 * MILLI));
                myWheel.runDue(Runnable::run);
                long now = myClock.nanos();
                assertThat(actual)
                        .as("seed %d", seed)
                        .containsExactlyInAnyOrderElementsOf(expected.stream()
                                .filter(due -> due.deadline <= now)
                                .map(Due::number)
                                .toList());
            }
            myClock.advance(Duration.ofSeconds(10));
            myWheel.runDue(Runnable::run);
            expected.sort(Comparator.comparingLong(Due::deadline).thenComparing(Due::number));
            assertThat(actual).as("seed %d", seed).hasSameSizeAs(expected);
        }
    }
}
