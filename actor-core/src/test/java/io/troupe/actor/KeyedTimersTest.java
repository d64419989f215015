package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.actor.time.Timer;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class KeyedTimersTest {
    private static final Duration SECOND = Duration.ofSeconds(1);

    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();
    private final List<Clockwork> instances = new ArrayList<>();

    /** Runs the tasks of the test on the space's thread. */
    public static class Clockwork extends Actor {
        public void then(Runnable task) {
            task.run();
        }

        Timer later(Object key, Duration delay, Runnable task) {
            return after(key, delay, task);
        }

        Timer again(Object key, Duration period, Runnable task) {
            return every(key, period, task);
        }

        Timer plain(Duration delay, Runnable task) {
            return after(delay, task);
        }

        boolean forget(Object key) {
            return cancelTimer(key);
        }
    }

    private Clockwork spawn() {
        return test.space()
                .spawn(
                        Clockwork.class,
                        () -> {
                            instances.add(new Clockwork());
                            return instances.getLast();
                        },
                        ActorSettings.DEFAULT.withSupervision(Supervision.restart(3, SECOND)));
    }

    /** On behalf of the current instance. */
    private void run(Clockwork proxy, Runnable task) {
        proxy.then(task);
        test.crank();
    }

    private Clockwork me() {
        return instances.getLast();
    }

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void timerWithAnEqualKey_replacesTheOneThatWaits() {
        Clockwork proxy = spawn();
        run(proxy, () -> me().later(List.of("beep", 1), SECOND, () -> log.add("first")));
        run(proxy, () -> me().later(List.of("beep", 1), SECOND.multipliedBy(2), () -> log.add("second")));
        test.advance(SECOND.multipliedBy(5));
        assertThat(log).containsExactly("second");
    }

    @Test
    void timersWithOtherKeys_ofOtherActors_orWithoutAKey_areLeftAlone() {
        Clockwork proxy = spawn();
        Clockwork other = spawn();
        test.crank();
        run(other, () -> instances.get(1).later("key", SECOND, () -> log.add("another's")));
        run(proxy, () -> {
            Clockwork mine = instances.get(0);
            mine.plain(SECOND, () -> log.add("without a key"));
            mine.later("other key", SECOND, () -> log.add("other key"));
            mine.later("key", SECOND, () -> log.add("key"));
        });
        test.advance(SECOND);
        assertThat(log).containsExactly("another's", "without a key", "other key", "key");
    }

    @Test
    void replacedTimer_thatIsDueInTheSamePass_doesNotRun() {
        Clockwork proxy = spawn();
        run(proxy, () -> {
            me().plain(SECOND, () -> me().later("key", SECOND, () -> log.add("new")));
            me().later("key", SECOND, () -> log.add("old"));
        });
        test.advance(SECOND);
        assertThat(log).isEmpty();
        test.advance(SECOND);
        assertThat(log).containsExactly("new");
    }

    @Test
    void replacedPeriodicTimer_thatIsDueInTheSamePass_doesNotRun() {
        Clockwork proxy = spawn();
        run(proxy, () -> {
            me().plain(SECOND, () -> me().again("key", SECOND, () -> log.add("new")));
            me().again("key", SECOND, () -> log.add("old"));
        });
        test.advance(SECOND);
        assertThat(log).isEmpty();
        test.advance(SECOND.multipliedBy(2));
        assertThat(log).containsExactly("new", "new");
    }

    @Test
    void onceTimer_replacesAPeriodicOne_andTheOtherWayRound() {
        Clockwork proxy = spawn();
        run(proxy, () -> me().again("key", SECOND, () -> log.add("again")));
        test.advance(SECOND.multipliedBy(2));
        run(proxy, () -> me().later("key", SECOND, () -> log.add("once")));
        test.advance(SECOND.multipliedBy(3));
        assertThat(log).containsExactly("again", "again", "once");
        run(proxy, () -> me().again("key", SECOND, () -> log.add("again")));
        test.advance(SECOND.multipliedBy(2));
        assertThat(log).containsExactly("again", "again", "once", "again", "again");
    }

    @Test
    void task_maySetItsOwnKeyAnew() {
        Clockwork proxy = spawn();
        run(proxy, () -> me().later("key", SECOND, this::backOff));
        test.advance(SECOND.multipliedBy(10));
        assertThat(log).containsExactly("turn");
        test.advance(SECOND.multipliedBy(10));
        test.advance(SECOND.multipliedBy(10));
        assertThat(log).containsExactly("turn", "turn", "turn");
        assertThat(me().keyedTimers().size()).isOne();
    }

    private void backOff() {
        log.add("turn");
        me().later("key", SECOND.multipliedBy(10), this::backOff);
    }

    @Test
    void task_mayCancelItsOwnPeriod() {
        Clockwork proxy = spawn();
        run(proxy, () -> me().again("key", SECOND, () -> log.add("cancelled: " + me().forget("key"))));
        test.advance(SECOND.multipliedBy(5));
        assertThat(log).containsExactly("cancelled: true");
    }

    @Test
    void cancelTimer_returnsWhetherOneWasGoingToRun() {
        Clockwork proxy = spawn();
        run(proxy, () -> {
            log.add("unknown: " + me().forget("key"));
            me().later("key", SECOND, () -> log.add("never"));
            log.add("waiting: " + me().forget("key"));
            log.add("cancelled: " + me().forget("key"));
            me().later("key", SECOND, () -> log.add("never")).cancel();
            log.add("cancelled by its handle: " + me().forget("key"));
            me().later("key", SECOND, () -> log.add("ran"));
        });
        test.advance(SECOND);
        run(proxy, () -> log.add("over: " + me().forget("key")));
        assertThat(log)
                .containsExactly(
                        "unknown: false",
                        "waiting: true",
                        "cancelled: false",
                        "cancelled by its handle: false",
                        "ran",
                        "over: false");
    }

    @Test
    void stoppedActor_hasNoTimers() {
        Clockwork proxy = spawn();
        run(proxy, () -> {
            me().later("once", SECOND, () -> log.add("once"));
            me().again("again", SECOND, () -> log.add("again"));
        });
        test.space().stop(proxy);
        test.advance(SECOND.multipliedBy(3));
        assertThat(log).isEmpty();
    }

    @Test
    void restartedActor_beginsWithoutTimers_evenIfTheFactoryAnswersTheSameObject() {
        var same = new Clockwork();
        Clockwork proxy = test.space()
                .spawn(
                        Clockwork.class,
                        () -> same,
                        ActorSettings.DEFAULT.withSupervision(Supervision.restart(3, SECOND)));
        run(proxy, () -> same.again("key", SECOND, () -> log.add("old")));
        run(proxy, () -> {
            throw new IllegalStateException("on purpose");
        });
        assertThat(test.takeProblems()).hasSize(1);
        assertThat(same.keyedTimers().size()).isZero();
        run(proxy, () -> log.add("waiting: " + same.forget("key")));
        run(proxy, () -> same.later("key", SECOND, () -> log.add("new")));
        test.advance(SECOND.multipliedBy(3));
        assertThat(log).containsExactly("waiting: false", "new");
    }

    @Test
    void finishedTimers_areNotRemembered() {
        Clockwork proxy = spawn();
        run(proxy, () -> {
            for (int i = 0; i < 1_000; i++) {
                me().later(i, SECOND, () -> {});
            }
        });
        assertThat(me().keyedTimers().size()).isEqualTo(1_000);
        test.advance(SECOND);
        assertThat(me().keyedTimers().size()).isZero();
    }

    @Test
    void timersCancelledByTheirHandle_doNotPileUp() {
        Clockwork proxy = spawn();
        run(proxy, () -> {
            me().later("kept", SECOND, () -> log.add("kept"));
            for (int i = 0; i < 10_000; i++) {
                me().later(i, SECOND, () -> log.add("cancelled")).cancel();
            }
        });
        assertThat(me().keyedTimers().size()).isLessThanOrEqualTo(16);
        test.advance(SECOND);
        assertThat(log).containsExactly("kept");
    }

    @Test
    void misuse_isRejected_andLeavesTheTimerThatWaits() {
        Clockwork proxy = spawn();
        run(proxy, () -> {
            me().later("key", SECOND, () -> log.add("kept"));
            assertThatThrownBy(() -> me().again("key", Duration.ZERO, () -> {}))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage("the period is PT0S, expected more than zero");
            assertThatThrownBy(() -> me().later("key", SECOND, null))
                    .isInstanceOf(NullPointerException.class)
                    .hasMessage("task");
            assertThatThrownBy(() -> me().later(null, SECOND, () -> {}))
                    .isInstanceOf(NullPointerException.class)
                    .hasMessage("key");
            assertThatThrownBy(() -> me().forget(null))
                    .isInstanceOf(NullPointerException.class)
                    .hasMessage("key");
        });
        assertThatThrownBy(() -> me().later("key", SECOND, () -> {}))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("after(..) belongs on the thread of space test-space");
        assertThatThrownBy(() -> me().forget("key"))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("cancelTimer(..) belongs on the thread of space test-space");
        test.advance(SECOND);
        assertThat(log).containsExactly("kept");
    }
}
