package io.troupe.actor;

import static io.troupe.actor.Concurrently.onAnotherThread;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class SupervisionTest extends InTestSpace {
    private static final Duration TEN_SECONDS = Duration.ofSeconds(10);
    private static final Duration PAUSE = Duration.ofMillis(10);

    private final Deferred<String> later = new Deferred<>();
    private int instances;
    private boolean refuses;

    /** Counts, and fails on demand. */
    class Fragile extends Actor {
        private final int instance = ++instances;
        private int count;

        @Override
        protected void started() {
            log.add("start " + instance);
            context().every(Duration.ofSeconds(1), () -> log.add("tick of " + instance));
        }

        @Override
        protected void stopped() {
            log.add("stop " + instance);
        }

        public Promise<Integer> count() {
            return Promise.of(++count);
        }

        public void fail() {
            throw new IllegalStateException("failure of " + instance);
        }

        public Promise<String> failRequest() {
            throw new IllegalStateException("answer of " + instance);
        }

        public void listen() {
            later.thenAccept(value -> log.add(value + " heard by " + instance));
        }
    }

    private Fragile spawn(Supervision supervision) {
        var settings = ActorSettings.named("fragile").withSupervision(supervision);
        return test.spawn(Fragile.class, Fragile::new, settings);
    }

    @Test
    void resume_keepsTheState() {
        Fragile fragile = spawn(Supervision.RESUME);
        test.get(fragile.count());
        fragile.fail();
        assertThat(test.get(fragile.count())).isEqualTo(2);
        assertThat(test.takeProblems()).hasSize(1);
        assertThat(instances).isEqualTo(1);
    }

    @Test
    void restart_makesANewInstanceBehindTheSameProxy_andKeepsTheMailbox() {
        Fragile fragile = spawn(Supervision.restart(3, TEN_SECONDS));
        test.get(fragile.count());
        fragile.listen();
        fragile.fail();
        Promise<Integer> waited = fragile.count();
        assertThat(test.get(waited)).isEqualTo(1);
        assertThat(log).containsExactly("start 1", "stop 1", "start 2");
        assertThat(test.takeProblems()).hasSize(1);
        later.resolve("late");
        test.advance(Duration.ofSeconds(1)); // timers and listeners of the old instance do not run
        assertThat(log).containsExactly("start 1", "stop 1", "start 2", "tick of 2");
    }

    @Test
    void moreFailuresThanTheLimit_stopTheActor_andItsWatchersAreNotified() {
        Fragile fragile = spawn(Supervision.restart(2, TEN_SECONDS));
        Promise<ActorEnd> stopped = test.space().whenStopped(fragile);
        for (int i = 0; i < 3; i++) {
            assertThat(stopped.isDone()).isFalse();
            fragile.fail();
            test.runQueued();
        }
        assertThat(stopped.isDone()).isTrue();
        assertThat(test.error(fragile.count())).isInstanceOf(ActorStoppedException.class);
        assertThat(test.takeProblems()).hasSize(3);
        assertThat(instances).isEqualTo(3);
    }

    @Test
    void failuresFarApart_areForgiven() {
        Fragile fragile = spawn(Supervision.restart(1, TEN_SECONDS));
        for (int i = 0; i < 5; i++) {
            fragile.fail();
            test.advance(TEN_SECONDS);
        }
        assertThat(test.get(fragile.count())).isEqualTo(1);
        assertThat(instances).isEqualTo(6);
        test.takeProblems();
    }

    @Test
    void stop_endsTheActorAtItsFirstFailure() {
        Fragile fragile = spawn(Supervision.STOP);
        fragile.fail();
        assertThat(test.error(fragile.count())).isInstanceOf(ActorStoppedException.class);
        assertThat(log).containsExactly("start 1", "stop 1");
        test.takeProblems();
    }

    @Test
    void failingRequest_isAnAnswerAndNoFailure() {
        Fragile fragile = spawn(Supervision.STOP);
        assertThat(test.error(fragile.failRequest())).hasMessage("answer of 1");
        assertThat(test.get(fragile.count())).isEqualTo(1);
    }

    @Test
    void whenStopped_isFulfilledForAnActorThatHasStopped() {
        Fragile fragile = spawn(Supervision.RESUME);
        stop(fragile);
        assertThat(test.space().whenStopped(fragile).isDone()).isTrue();
        assertThatThrownBy(() -> test.space().whenStopped("nobody")).hasMessageContaining("not a proxy");
    }

    @Test
    void settingsThatMakeNoSense_areRejected() {
        assertThatThrownBy(() -> Supervision.restart(-1, Duration.ofSeconds(1))).hasMessageContaining("limit is -1");
        assertThatThrownBy(() -> Supervision.restart(1, Duration.ZERO)).hasMessageContaining("window is PT0S");
    }

    // ---- an actor whose restart fails

    /** Starts only when the test allows it. */
    class Stubborn extends Actor {
        Stubborn() {
            instances++;
        }

        @Override
        protected void started() {
            if (refuses) {
                throw new IllegalStateException("cannot start");
            }
        }

        public void note(int number) {
            log.add("note " + number);
        }

        public void fail() {
            throw new IllegalStateException("failed later");
        }
    }

    /** Would not return without pauses between the starts. */
    private Stubborn spawnStubborn(ActorSettings settings) {
        refuses = true;
        var unlimited = settings.withSupervision(Supervision.restart(Integer.MAX_VALUE, TEN_SECONDS));
        return test.spawn(Stubborn.class, Stubborn::new, unlimited);
    }

    private static void note(Stubborn stubborn, int first, int last) {
        IntStream.rangeClosed(first, last).forEach(stubborn::note);
    }

    private int timers() {
        return test.space().metrics().timers();
    }

    @Test
    @Timeout(60)
    void unlimitedRestart_whoseStartThrows_leavesTimeForOthers_andWaitsLongerAndLonger() {
        spawnStubborn(ActorSettings.defaults());
        Fragile other = spawn(Supervision.RESUME);
        assertThat(test.get(other.count())).isEqualTo(1);
        instances = 0;
        var started = new ArrayList<Integer>();
        int rising = 80 + 160 + 320 + 640 + 1_280 + 2_560 + 5_120;
        for (int millis : new int[] {9, 1, 20, 39, 1, rising, 100_000}) { // no pause is longer than 10 s
            test.advance(Duration.ofMillis(millis));
            started.add(instances);
        }
        assertThat(started).containsExactly(0, 1, 2, 2, 3, 3 + 7, 10 + 10);
        assertThat(test.takeProblems()).hasSizeGreaterThan(20);
    }

    @Test
    @Timeout(60)
    void callsOfAnActorThatWaitsForItsRestart_areServedInOrder_whenItHasStarted() {
        Stubborn stubborn = spawnStubborn(ActorSettings.defaults());
        note(stubborn, 1, 3);
        test.runQueued();
        assertThat(log).isEmpty();
        refuses = false;
        test.run(() -> {
            note(stubborn, 4, 6);
            test.clock().advance(PAUSE); // due while these are in the mailbox
        });
        assertThat(log).containsExactly("note 1", "note 2", "note 3", "note 4", "note 5", "note 6");
        stubborn.note(7);
        stubborn.fail();
        stubborn.note(8);
        test.runQueued();
        assertThat(log).endsWith("note 6", "note 7", "note 8");
        test.takeProblems();
    }

    @Test
    @Timeout(60)
    void callsOfAnActorThatWaitsForItsRestart_areRejected_whenItStops_andNoTimerIsLeft() {
        Stubborn stubborn = spawnStubborn(ActorSettings.defaults().withMailbox(2, Overflow.DROP_OLDEST));
        assertThat(timers()).isOne();
        note(stubborn, 1, 2);
        test.runQueued();
        stop(stubborn);
        assertThat(test.takeDeadLetters()).hasSize(2);
        assertThat(timers()).isZero();
        test.advance(TEN_SECONDS);
        assertThat(instances).isEqualTo(2);
        test.takeProblems();
    }

    @Test
    @Timeout(60)
    void callsThatWereHeldBack_areServedBeforeTheStopThatCameAfterThem() {
        Stubborn stubborn = spawnStubborn(ActorSettings.defaults());
        note(stubborn, 1, 400);
        test.runQueued();
        refuses = false;
        test.run(() -> test.space().delay(PAUSE).thenRun(() -> {
            test.space().stop(stubborn); // runs after 256 callbacks
            stubborn.note(401);
        }));
        test.advance(PAUSE);
        assertThat(log).hasSize(400).endsWith("note 400");
        assertThat(test.takeDeadLetters()).hasSize(1);
        test.takeProblems();
    }

    @Test
    @Timeout(60)
    void failureAmongCallsThatWereHeldBack_beforeAStop_letsItStopInsteadOfWaitingForARestart() {
        Stubborn stubborn = spawnStubborn(ActorSettings.defaults());
        note(stubborn, 1, 300);
        stubborn.fail();
        test.runQueued();
        refuses = false;
        var stopped = test.space().whenStopped(stubborn);
        test.run(() -> test.space().delay(PAUSE).thenRun(() -> {
            refuses = true;
            test.space().stop(stubborn); // runs after 256 callbacks
        }));
        test.advance(PAUSE);
        assertThat(stopped.isDone()).isTrue();
        assertThat(log).hasSize(300);
        assertThat(timers()).isZero();
        test.takeProblems();
    }

    @Test
    @Timeout(60)
    void failedStartsInARow_reachTheLimit_thoughThePausesExceedTheWindow() {
        refuses = true;
        var settings = ActorSettings.defaults().withSupervision(Supervision.restart(5, Duration.ofMillis(15)));
        Stubborn stubborn = test.spawn(Stubborn.class, Stubborn::new, settings);
        var stopped = test.space().whenStopped(stubborn);
        test.advance(Duration.ofSeconds(60));
        assertThat(stopped.isDone()).isTrue();
        assertThat(instances).isEqualTo(1 + 5);
        assertThat(test.takeProblems()).hasSize(1 + 5);
    }

    /**
     * Spawned on another thread within a turn, so that the caller's call is queued before the entry that starts the
     * actor.
     */
    private void callBeforeTheSpawnEntry(Supervision supervision) {
        refuses = true;
        var settings = ActorSettings.defaults().withSupervision(supervision);
        test.run(() -> {
            var spawned = new AtomicReference<Stubborn>();
            onAnotherThread(() -> spawned.set(test.space().spawn(Stubborn.class, Stubborn::new, settings)));
            note(spawned.get(), 7, 8);
        });
        test.takeProblems();
        assertThat(log).isEmpty();
    }

    @Test
    void callBeforeTheSpawnEntry_doesNotReachAnInstanceWhoseStartThrows() {
        callBeforeTheSpawnEntry(Supervision.STOP);
        assertThat(test.takeDeadLetters()).hasSize(2);
    }

    @Test
    @Timeout(60)
    void callBeforeTheSpawnEntry_waitsForTheRestart_ifTheStartThrows() {
        callBeforeTheSpawnEntry(Supervision.restart(100, TEN_SECONDS));
        refuses = false;
        test.advance(PAUSE);
        assertThat(log).containsExactly("note 7", "note 8");
        assertThat(instances).isEqualTo(3);
    }

    // ---- pauses

    @Test
    void pauses_double_upToTheLongest_andBeginAgainAfterARunWithoutFailure() {
        var second = Duration.ofSeconds(1);
        Fragile fragile =
                spawn(Supervision.restart(Integer.MAX_VALUE, TEN_SECONDS).withPauses(second, second.multipliedBy(3)));
        test.runQueued();
        for (int pauseSeconds : new int[] {1, 2, 3, 3}) {
            fragile.fail();
            int before = instances;
            test.advance(second.multipliedBy(pauseSeconds).minusNanos(1));
            assertThat(instances).isEqualTo(before);
            test.advance(Duration.ofNanos(1));
            assertThat(instances).isEqualTo(before + 1);
        }
        test.advance(TEN_SECONDS);
        fragile.fail();
        test.advance(second);
        assertThat(instances).isEqualTo(6);
        assertThat(test.takeProblems()).hasSize(5);
    }

    @Test
    void callsDuringAPause_waitInOrder_andALimitCountsTheRow_thoughThePausesExceedTheWindow() {
        var second = Duration.ofSeconds(1);
        Fragile fragile = spawn(Supervision.restart(2, second).withPauses(TEN_SECONDS, TEN_SECONDS));
        Promise<ActorEnd> end = test.space().whenStopped(fragile);
        fragile.fail();
        test.runQueued();
        Promise<Integer> first = fragile.count();
        Promise<Integer> next = fragile.count();
        test.advance(TEN_SECONDS);
        assertThat(values(first, next)).containsExactly(1, 2);
        fragile.fail();
        test.advance(TEN_SECONDS);
        assertThat(end.isDone()).isFalse();
        fragile.fail();
        assertThat(test.get(end)).isInstanceOf(ActorEnd.Failed.class);
        assertThat(instances).isEqualTo(3);
        assertThat(timers()).isZero();
        test.takeProblems();
    }

    // ---- by the type of the error

    /** Throws what it is given. */
    class Thrower extends Actor {
        private final int instance = ++instances;

        public void send(RuntimeException error) {
            throw error;
        }

        public Promise<Integer> ask(RuntimeException error) {
            throw error;
        }

        public void hear(Promise<?> promise, RuntimeException error) {
            promise.then(value -> {
                throw error;
            });
        }

        public Promise<Integer> instance() {
            return Promise.of(instance);
        }
    }

    private Thrower spawnThrower(Supervision supervision) {
        var settings = ActorSettings.named("thrower").withSupervision(supervision);
        return test.spawn(Thrower.class, Thrower::new, settings);
    }

    private static RuntimeException illegal(String text) {
        return new IllegalArgumentException(text);
    }

    private static RuntimeException broken(String text) {
        return new IllegalStateException(text);
    }

    @Test
    void cases_applyToTheirErrors_theFirstThatMatches_andCountSeparately() {
        Thrower thrower = spawnThrower(Supervision.STOP
                .on(IllegalArgumentException.class, Supervision.RESUME)
                .on(IllegalStateException.class, Supervision.restart(1, TEN_SECONDS))
                .on(RuntimeException.class, Supervision.restart(1, TEN_SECONDS)));
        thrower.send(illegal("a"));
        thrower.send(illegal("b"));
        assertThat(test.get(thrower.instance())).isEqualTo(1);
        thrower.send(broken("c"));
        assertThat(test.get(thrower.instance())).isEqualTo(2);
        thrower.send(new UnsupportedOperationException("d"));
        assertThat(test.get(thrower.instance())).isEqualTo(3);
        thrower.send(broken("e"));
        assertThat(test.get(test.space().whenStopped(thrower)))
                .isInstanceOfSatisfying(
                        ActorEnd.Failed.class, end -> assertThat(end.error()).hasMessage("e"));
        assertThat(takeErrors()).containsExactly("a", "b", "c", "d", "e");
    }

    // ---- failures of requests and listeners

    @Test
    void requestsAndListeners_count_ifTheSupervisionSaysSo_andAreReportedOnce() {
        Thrower thrower = spawnThrower(Supervision.restart(9, TEN_SECONDS).withRequestsAndListeners());
        assertThat(test.error(thrower.ask(broken("asked")))).hasMessage("asked");
        assertThat(test.get(thrower.instance())).isEqualTo(2);
        thrower.hear(Promise.of(1), broken("heard"));
        assertThat(test.get(thrower.instance())).isEqualTo(3);
        assertThat(test.takeProblems())
                .extracting(problem -> problem.where() + ": " + problem.error().getMessage())
                .containsExactly("Thrower.ask(RuntimeException) of thrower: asked", "a listener of thrower: heard");
    }

    @Test
    void requestsAndListeners_countForTheErrorsOfACaseOnly() {
        Thrower thrower = spawnThrower(Supervision.STOP
                .on(IllegalArgumentException.class, Supervision.RESUME)
                .withRequestsAndListeners());
        assertThat(test.error(thrower.ask(illegal("bad argument")))).hasMessage("bad argument");
        assertThat(test.get(thrower.instance())).isEqualTo(1);
        assertThat(test.takeProblems()).isEmpty();
        assertThat(test.error(thrower.ask(broken("broken")))).hasMessage("broken");
        assertThat(test.get(test.space().whenStopped(thrower))).isInstanceOf(ActorEnd.Failed.class);
        assertThat(takeErrors()).containsExactly("broken");
    }

    // ---- the reason of an end

    @Test
    void whenStopped_saysWhy_toEarlyAndLateWatchers() {
        Thrower failing = spawnThrower(Supervision.STOP);
        Thrower stopping = spawnThrower(Supervision.STOP);
        Thrower restarted = spawnThrower(Supervision.restart(9, TEN_SECONDS));
        Promise<ActorEnd> early = test.space().whenStopped(failing);
        var error = broken("broken");
        failing.send(error);
        restarted.send(broken("restarts"));
        test.runQueued();
        stop(stopping);
        stop(restarted);
        assertThat(values(early, test.space().whenStopped(failing)))
                .containsOnly(new ActorEnd.Failed(error))
                .hasSize(2);
        assertThat(values(test.space().whenStopped(stopping), test.space().whenStopped(restarted)))
                .containsOnly(new ActorEnd.Stopped());
        test.takeProblems();
    }

    @Test
    void whenStopped_ofAnActorWhoseFactoryThrows_saysSo() {
        var error = broken("no instance");
        Thrower thrower = test.spawn(Thrower.class, () -> {
            throw error;
        });
        assertThat(test.get(test.space().whenStopped(thrower))).isEqualTo(new ActorEnd.Failed(error));
        test.takeProblems();
    }

    @Test
    void pausesThatMakeNoSense_areRejected() {
        Supervision restart = Supervision.restart(1, TEN_SECONDS);
        assertThatThrownBy(() -> restart.withPauses(TEN_SECONDS, PAUSE))
                .hasMessage("firstPause is PT10S, expected between zero and longestPause, which is PT0.01S");
        assertThatThrownBy(() -> Supervision.STOP.withPauses(PAUSE, PAUSE))
                .hasMessage("firstPause is PT0.01S, expected zero: nothing is restarted after STOP");
    }
}
