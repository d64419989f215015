package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

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

    /** Sets a timer that adds a text to the log. */
    private Timer set(String text, long delayNanos, long periodNanos) {
        return wheel.set(() -> log.add(text), delayNanos, periodNanos);
    }

    @Test
    void periodicTimer_runsOncePerPeriodThatIsOver_untilCancelled() {
        Timer timer = set("tick", 100 * MILLI, 100 * MILLI);
        advanceMillis(1_050);
        assertThat(log).hasSize(10);
        assertThat(timer.cancel()).isTrue();
        assertThat(timer.cancel()).isFalse();
        advanceMillis(1_000);
        assertThat(log).hasSize(10);
    }

    @Test
    void periodicTimer_thatIsLate_letsOthersHaveTheirTurn() {
        set("fast", MILLI, MILLI);
        clock.advance(Duration.ofMillis(10));
        assertThat(wheel.runDue(Runnable::run)).isEqualTo(1);
        assertThat(wheel.isDue()).isTrue();
        set("other", 0, 0);
        assertThat(wheel.runDue(Runnable::run)).isEqualTo(2);
        assertThat(log).containsExactly("fast", "fast", "other");
    }

    @Test
    void timerForTheEndOfTime_andOneCancelledByAnEarlierOne_doNotRun() {
        set("never", Long.MAX_VALUE, 0);
        var second = new Timer[1];
        wheel.set(() -> second[0].cancel(), MILLI, 0);
        second[0] = set("never", 2 * MILLI, 0);
        advanceMillis(5);
        advanceMillis(10_000);
        assertThat(log).isEmpty();
    }

    @Test
    void negativePeriod_isRejected() {
        assertThatThrownBy(() -> wheel.set(() -> {}, 0, -1)).hasMessageContaining("-1 ns");
    }

    @Test
    void sleep_isUntilTheNextDeadline_butWithManyTimersUpToTwoMillisecondsLonger() {
        assertThat(wheel.sleepNanos(MILLI)).isEqualTo(MILLI);
        set("soon", 5_000, 0);
        assertThat(wheel.sleepNanos(MILLI)).isEqualTo(5_000);
        assertThat(wheel.sleepNanos(4_000)).isEqualTo(4_000);
        IntStream.range(0, 999).forEach(number -> set("later", 60_000 * MILLI, 0));
        assertThat(wheel.sleepNanos(MILLI)).as("1,000 timers").isEqualTo(200_000);
        IntStream.range(0, 99_000).forEach(number -> set("later", 60_000 * MILLI, 0));
        assertThat(wheel.sleepNanos(3 * MILLI)).as("100,000 timers").isEqualTo(2 * MILLI);
        advanceMillis(1);
        assertThat(log).containsExactly("soon");
        assertThat(wheel.sleepNanos(Long.MAX_VALUE))
                .as("the far ones, or the start of their slot")
                .isBetween(30_000 * MILLI, 60_000 * MILLI);
    }

    /** Counts the comparisons of timers: the work that remains when slots are found by a bit scan. */
    private static final class CountingHeap extends TimerWheel.Heap {
        private long comparisons;

        @Override
        boolean isEarlier(TimerWheel.WheelTimer timer, TimerWheel.WheelTimer other) {
            comparisons++;
            return super.isEarlier(timer, other);
        }
    }

    private final CountingHeap heap = new CountingHeap();
    private final TimerWheel countedWheel = new TimerWheel(clock, () -> true, heap);

    @Test
    void manyTimers_dueTogether_costTheLogarithmEach() {
        int count = 30_000;
        var ran = new ArrayList<Integer>();
        for (int number = 0; number < count; number++) {
            int id = number;
            countedWheel.set(() -> ran.add(id), 1_000 * MILLI - number % 7, 0);
        }
        clock.advance(Duration.ofSeconds(1));
        assertThat(countedWheel.runDue(Runnable::run)).isEqualTo(count);
        assertThat(ran)
                .containsExactlyElementsOf(IntStream.range(0, count)
                        .boxed()
                        .sorted(Comparator.<Integer>comparingInt(id -> -(id % 7))
                                .thenComparing(id -> id))
                        .toList());
        int levels = 8; // of a heap with four children each
        assertThat(heap.comparisons).isGreaterThan(count).isLessThan(count * (levels + 4L * levels));
    }

    @Test
    void latePeriodicTimer_besideManyFarOnes_costsNothingForThem() {
        for (int number = 0; number < 100_000; number++) {
            countedWheel.set(() -> log.add("far"), 10_000 * MILLI + number * 1_000L, 0);
        }
        countedWheel.set(() -> log.add("tick"), MILLI, MILLI);
        clock.advance(Duration.ofMillis(600));
        int passes = 0;
        while (countedWheel.isDue()) {
            assertThat(countedWheel.runDue(Runnable::run)).isEqualTo(1);
            passes++;
        }
        assertThat(passes).isEqualTo(600);
        assertThat(log).hasSize(600).containsOnly("tick");
        assertThat(heap.comparisons).isLessThan(10);
        assertThat(countedWheel.size()).isEqualTo(100_001);
    }

    @Test
    void timersThatAreCancelled_leaveNothingBehind() {
        var timers = new ArrayList<Timer>();
        for (int number = 0; number < 1_000; number++) {
            timers.add(set("never", number * 700_000L, 0));
        }
        timers.forEach(timer -> assertThat(timer.cancel()).isTrue());
        assertThat(wheel.isEmpty()).isTrue();
        assertThat(wheel.nextDeadline()).isEqualTo(Long.MAX_VALUE);
        advanceMillis(2_000);
        assertThat(log).isEmpty();
    }

    @Test
    void timerSetByARunningOne_andDueAtOnce_runsBehindTheOthersThatAreDue() {
        Runnable first = () -> {
            log.add("first");
            set("new", 0, 0);
        };
        wheel.set(first, MILLI, 0);
        set("second", 2 * MILLI, 0);
        set("third", 5 * MILLI, 0);
        advanceMillis(5);
        assertThat(log).containsExactly("first", "second", "third", "new");
    }

    @Test
    void skipMissed_runsOnceForAllThatItMissed_andKeepsItsPhase() {
        wheel.set(() -> log.add("at " + clock.nanos() / MILLI), 100 * MILLI, 100 * MILLI, Schedule.SKIP_MISSED);
        advanceMillis(350);
        advanceMillis(49);
        advanceMillis(1);
        advanceMillis(100);
        assertThat(log).containsExactly("at 350", "at 400", "at 500");
    }

    @Test
    void fixedDelay_countsFromTheEndOfARun() {
        Runnable task = () -> {
            log.add("from " + clock.nanos() / MILLI);
            clock.advance(Duration.ofMillis(30)); // the duration of the run
        };
        wheel.set(task, 100 * MILLI, 100 * MILLI, Schedule.FIXED_DELAY);
        advanceMillis(250);
        assertThat(log).containsExactly("from 250");
        advanceMillis(99);
        assertThat(log).hasSize(1);
        advanceMillis(1);
        assertThat(log).containsExactly("from 250", "from 380");
    }

    @Test
    void fixedDelay_ofATaskThatThrows_goesOn() {
        Runnable task = () -> {
            log.add("run");
            throw new IllegalStateException("broken");
        };
        wheel.set(task, 100 * MILLI, 100 * MILLI, Schedule.FIXED_DELAY);
        for (int run = 0; run < 2; run++) {
            clock.advance(Duration.ofMillis(100));
            assertThatThrownBy(() -> wheel.runDue(Runnable::run)).hasMessage("broken");
        }
        assertThat(log).hasSize(2);
        assertThat(wheel.size()).isEqualTo(1);
    }

    private final SteppedClock running = new SteppedClock();

    @Test
    void fixedRate_onAClockThatRunsByItself_makesUpForOneSecondAtMost() {
        var myWheel = new TimerWheel(running);
        myWheel.set(() -> log.add("tick"), 10 * MILLI, 10 * MILLI);
        running.nanos += 60_000 * MILLI + 5 * MILLI;
        while (myWheel.isDue()) {
            myWheel.runDue(Runnable::run);
        }
        assertThat(log).hasSize(101); // the one that was due, and those of the last second
        assertThat(myWheel.nextDeadline()).isEqualTo(60_010 * MILLI);
    }

    @Test
    void wheelOfAClockThatBeganBelowZero_runsItsTimers() {
        running.nanos = -5 * MILLI;
        var myWheel = new TimerWheel(running);
        for (long millis : new long[] {1, 4, 5, 6, 500, 100_000, 10_000_000}) {
            myWheel.set(() -> log.add("at " + running.nanos / MILLI), millis * MILLI, 0);
        }
        while (!myWheel.isEmpty()) {
            running.nanos = Math.max(running.nanos, myWheel.nextDeadline());
            myWheel.runDue(Runnable::run);
        }
        assertThat(log).containsExactly("at -4", "at -1", "at 0", "at 1", "at 495", "at 99995", "at 9999995");
    }

    // ---- random timers, compared with a list sorted by deadline and number

    private record Expected(long deadline, int number, Timer timer) {}

    private final List<Expected> expected = new ArrayList<>();
    private final List<Integer> actual = new ArrayList<>();

    static LongStream seeds() {
        return LongStream.rangeClosed(1, 200);
    }

    @ParameterizedTest(name = "seed {0}")
    @MethodSource("seeds")
    void randomTimers_runExactlyAsASortedListWould(long seed) {
        var random = new Random(seed);
        int number = 0;
        for (int round = 0; round < 60; round++) {
            for (int more = random.nextInt(8); more > 0; more--) {
                setRandom(random, number++);
            }
            for (int fewer = random.nextInt(3); fewer > 0 && !expected.isEmpty(); fewer--) {
                Expected removed = expected.remove(random.nextInt(expected.size()));
                assertThat(removed.timer.cancel()).isTrue();
            }
            checkNextDeadline();
            clock.advanceTo(clock.nanos() + random.nextLong(1L << random.nextInt(1, 45)));
            runDueAndCompare();
        }
        var rest = expected.stream().map(Expected::number).toList();
        clock.advanceTo(Long.MAX_VALUE);
        actual.clear();
        wheel.runDue(Runnable::run);
        assertThat(actual).isEqualTo(rest);
        assertThat(wheel.isEmpty()).isTrue();
    }

    private void setRandom(Random random, int number) {
        long delay = random.nextInt(4) == 0
                ? random.nextInt(5) * MILLI // so that some are equal
                : random.nextLong(1L << random.nextInt(1, 50));
        Timer timer = wheel.set(() -> actual.add(number), delay, 0);
        expected.add(new Expected(clock.nanos() + delay, number, timer));
        expected.sort(Comparator.comparingLong(Expected::deadline).thenComparing(Expected::number));
    }

    private void checkNextDeadline() {
        long deadline = expected.isEmpty() ? Long.MAX_VALUE : expected.getFirst().deadline;
        assertThat(wheel.nextDeadline()).isLessThanOrEqualTo(deadline);
        assertThat(wheel.isDue()).isEqualTo(deadline <= clock.nanos());
        assertThat(wheel.size()).isEqualTo(expected.size());
    }

    private void runDueAndCompare() {
        var due =
                expected.stream().filter(each -> each.deadline <= clock.nanos()).toList();
        actual.clear();
        assertThat(wheel.isDue()).isEqualTo(!due.isEmpty());
        wheel.runDue(Runnable::run);
        assertThat(actual).isEqualTo(due.stream().map(Expected::number).toList());
        expected.removeAll(due);
    }
}
