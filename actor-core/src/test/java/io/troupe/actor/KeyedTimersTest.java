package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.time.Duration;
import java.util.List;
import java.util.function.Consumer;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class KeyedTimersTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);

    private final Doer instance = new Doer(); // the factory answers it at a restart, too
    private final Doer actor = test.spawn(
            Doer.class, () -> instance, ActorSettings.defaults().withSupervision(Supervision.restart(3, SECOND)));

    private void run(Consumer<Doer> task) {
        actor.run(task);
        test.runQueued();
    }

    private void advanceSeconds(int seconds) {
        test.advance(SECOND.multipliedBy(seconds));
    }

    @Test
    void timerWithAnEqualKey_replacesTheOneThatWaits() {
        run(me -> me.context().after(List.of("beep", 1), SECOND, () -> log.add("first")));
        run(me -> me.context().after(List.of("beep", 1), SECOND.multipliedBy(2), () -> log.add("second")));
        advanceSeconds(5);
        assertThat(log).containsExactly("second");
    }

    @Test
    void timer_asText_saysWhenItIsDue() {
        run(me -> {
            var timer = me.context().every("key", SECOND, () -> {});
            log.add(timer.toString());
            log.add(me.context().after(SECOND, () -> {}).toString());
            timer.cancel();
            log.add(timer.toString());
        });
        assertThat(log)
                .containsExactly(
                        "timer due in PT1S, then every PT1S, FIXED_RATE",
                        "timer due in PT1S",
                        "timer that has run or was cancelled");
    }

    @Test
    void timer_isActive_untilItHasRunForTheLastTimeOrWasCancelled() {
        run(me -> {
            me.context()
                    .after("once", SECOND, () -> log.add("once " + me.context().isTimerActive("once")));
            me.context()
                    .every(
                            "again",
                            SECOND,
                            () -> log.add("again " + me.context().isTimerActive("again")));
            me.context().after("handle", SECOND, () -> {}).cancel();
            log.add(me.context().isTimerActive("once") + " " + me.context().isTimerActive("handle") + " "
                    + me.context().isTimerActive("none"));
        });
        advanceSeconds(1);
        run(me ->
                log.add(me.context().isTimerActive("once") + " " + me.context().isTimerActive("again")));
        run(me -> me.context().cancelTimer("again"));
        run(me -> log.add("" + me.context().isTimerActive("again")));
        assertThat(log).containsExactly("true false false", "once false", "again true", "false true", "false");
    }

    @Test
    void timersWithOtherKeys_ofOtherActors_orWithoutAKey_areLeftAlone() {
        Doer other = test.spawn(Doer.class, Doer::new);
        other.run(me -> me.context().after("key", SECOND, () -> log.add("another's")));
        run(me -> {
            me.context().after(SECOND, () -> log.add("without a key"));
            me.context().after("other key", SECOND, () -> log.add("other key"));
            me.context().after("key", SECOND, () -> log.add("key"));
        });
        advanceSeconds(1);
        assertThat(log).containsExactly("another's", "without a key", "other key", "key");
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void replacedTimer_thatIsDueInTheSamePass_doesNotRun(boolean periodic) {
        run(me -> {
            me.context().after(SECOND, () -> set(me, periodic, "new"));
            set(me, periodic, "old");
        });
        advanceSeconds(1);
        assertThat(log).isEmpty();
        advanceSeconds(periodic ? 2 : 1);
        assertThat(log).isEqualTo(periodic ? List.of("new", "new") : List.of("new"));
    }

    private void set(Doer me, boolean periodic, String text) {
        if (periodic) {
            me.context().every("key", SECOND, () -> log.add(text));
        } else {
            me.context().after("key", SECOND, () -> log.add(text));
        }
    }

    @Test
    void onceTimer_replacesAPeriodicOne_andTheOtherWayRound() {
        run(me -> set(me, true, "again"));
        advanceSeconds(2);
        run(me -> set(me, false, "once"));
        advanceSeconds(3);
        assertThat(log).containsExactly("again", "again", "once");
        run(me -> set(me, true, "again"));
        advanceSeconds(2);
        assertThat(log).containsExactly("again", "again", "once", "again", "again");
    }

    private void backOff() {
        log.add("turn");
        instance.context().after("key", SECOND.multipliedBy(10), this::backOff);
    }

    @Test
    void task_maySetItsOwnKeyAnew() {
        run(me -> me.context().after("key", SECOND, this::backOff));
        advanceSeconds(10);
        assertThat(log).containsExactly("turn");
        advanceSeconds(10);
        advanceSeconds(10);
        assertThat(log).containsExactly("turn", "turn", "turn");
        assertThat(instance.context().keyedTimers()).isOne();
    }

    @Test
    void task_mayCancelItsOwnPeriod() {
        run(me -> me.context()
                .every("key", SECOND, () -> log.add("cancelled: " + me.context().cancelTimer("key"))));
        advanceSeconds(5);
        assertThat(log).containsExactly("cancelled: true");
    }

    @Test
    void cancelTimer_returnsWhetherOneWasGoingToRun() {
        run(me -> {
            log.add("unknown: " + me.context().cancelTimer("key"));
            set(me, false, "never");
            log.add("waiting: " + me.context().cancelTimer("key"));
            log.add("cancelled: " + me.context().cancelTimer("key"));
            me.context().after("key", SECOND, () -> log.add("never")).cancel();
            log.add("cancelled by its handle: " + me.context().cancelTimer("key"));
            set(me, false, "ran");
        });
        advanceSeconds(1);
        run(me -> log.add("over: " + me.context().cancelTimer("key")));
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
    void restartedActor_beginsWithoutTimers_evenIfTheFactoryAnswersTheSameObject() {
        run(me -> set(me, true, "old"));
        run(me -> {
            throw new IllegalStateException("on purpose");
        });
        assertThat(test.takeProblems()).hasSize(1);
        assertThat(instance.context().keyedTimers()).isZero();
        run(me -> log.add("waiting: " + me.context().cancelTimer("key")));
        run(me -> set(me, false, "new"));
        advanceSeconds(3);
        assertThat(log).containsExactly("waiting: false", "new");
    }

    @Test
    void finishedTimers_areNotRemembered() {
        run(me -> {
            for (int i = 0; i < 1_000; i++) {
                me.context().after(i, SECOND, () -> {});
            }
        });
        assertThat(instance.context().keyedTimers()).isEqualTo(1_000);
        advanceSeconds(1);
        assertThat(instance.context().keyedTimers()).isZero();
    }

    @Test
    void timersCancelledByTheirHandle_doNotPileUp() {
        run(me -> {
            me.context().after("kept", SECOND, () -> log.add("kept"));
            for (int i = 0; i < 10_000; i++) {
                me.context().after(i, SECOND, () -> log.add("cancelled")).cancel();
            }
        });
        assertThat(instance.context().keyedTimers()).isLessThanOrEqualTo(16);
        advanceSeconds(1);
        assertThat(log).containsExactly("kept");
    }

    private static void rejects(Class<?> error, String message, ThrowingCallable call) {
        assertThatThrownBy(call).isInstanceOf(error).hasMessage(message);
    }

    @Test
    void misuse_isRejected_andLeavesTheTimerThatWaits() {
        String period = "the period is PT0S, expected more than zero";
        run(me -> {
            set(me, false, "kept");
            rejects(IllegalArgumentException.class, period, () -> me.context().every("key", Duration.ZERO, () -> {}));
            rejects(NullPointerException.class, "task", () -> me.context().after("key", SECOND, null));
            rejects(NullPointerException.class, "key", () -> me.context().after(null, SECOND, () -> {}));
            rejects(NullPointerException.class, "key", () -> me.context().cancelTimer(null));
        });
        assertThatThrownBy(() -> set(instance, false, "elsewhere"))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("context().after(..) of Doer#1 belongs on the thread of space test-space");
        assertThatThrownBy(() -> instance.context().cancelTimer("key"))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("context().cancelTimer(..) of Doer#1 belongs on the thread of space test-space");
        advanceSeconds(1);
        assertThat(log).containsExactly("kept");
    }
}
