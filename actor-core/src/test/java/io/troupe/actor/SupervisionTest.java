package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class SupervisionTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();
    private final Deferred<String> later = new Deferred<>();
    private int instances;
    private boolean refuses;

    /** Counts, and fails on demand. */
    public static class Fragile extends Actor {
        private final SupervisionTest outer;
        private final int instance;
        private int count;

        Fragile(SupervisionTest outer) {
            this.outer = outer;
            this.instance = ++outer.instances;
        }

        @Override
        protected void started() {
            outer.log.add("start " + instance);
            every(Duration.ofSeconds(1), () -> outer.log.add("tick of " + instance));
        }

        @Override
        protected void stopped() {
            outer.log.add("stop " + instance);
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
            outer.later.thenAccept(value -> outer.log.add(value + " heard by " + instance));
        }
    }

    private Fragile spawn(Supervision supervision) {
        Fragile fragile = test.space()
                .spawn(
                        Fragile.class,
                        () -> new Fragile(this),
                        ActorSettings.named("fragile").withSupervision(supervision));
        test.crank();
        return fragile;
    }

    @AfterEach
    void nothingIsLeft() {
        test.close();
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
        Fragile fragile = spawn(Supervision.restart(3, Duration.ofSeconds(10)));
        test.get(fragile.count());
        fragile.fail();
        Promise<Integer> waited = fragile.count();
        assertThat(test.get(waited)).isEqualTo(1);
        assertThat(log).containsExactly("start 1", "stop 1", "start 2");
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void restart_forgetsTimersAndListenersOfTheOldInstance() {
        Fragile fragile = spawn(Supervision.restart(3, Duration.ofSeconds(10)));
        fragile.listen();
        fragile.fail();
        test.crank();
        later.resolve("late");
        test.advance(Duration.ofSeconds(1));
        assertThat(log).containsExactly("start 1", "stop 1", "start 2", "tick of 2");
        test.takeProblems();
    }

    @Test
    void moreFailuresThanTheLimit_stopTheActor_andItsWatchersAreNotified() {
        Fragile fragile = spawn(Supervision.restart(2, Duration.ofSeconds(10)));
        Promise<Void> stopped = test.space().whenStopped(fragile);
        for (int i = 0; i < 3; i++) {
            assertThat(stopped.isDone()).isFalse();
            fragile.fail();
            test.crank();
        }
        assertThat(stopped.isDone()).isTrue();
        assertThat(test.error(fragile.count())).isInstanceOf(ActorStoppedException.class);
        assertThat(test.takeProblems()).hasSize(3);
        assertThat(instances).isEqualTo(3);
    }

    /** Starts only when the test allows it. */
    public static class Stubborn extends Actor {
        private final SupervisionTest outer;

        Stubborn(SupervisionTest outer) {
            this.outer = outer;
            outer.instances++;
        }

        @Override
        protected void started() {
            if (outer.refuses) {
                throw new IllegalStateException("cannot start");
            }
        }

        public void note(int number) {
            outer.log.add("note " + number);
        }

        public void fail() {
            throw new IllegalStateException("failed later");
        }
    }

    private Stubborn spawnStubborn(ActorSettings settings) {
        refuses = true;
        Stubborn stubborn = test.space()
                .spawn(
                        Stubborn.class,
                        () -> new Stubborn(this),
                        settings.withSupervision(Supervision.restart(Integer.MAX_VALUE, Duration.ofSeconds(10))));
        test.crank(); // would not return without pauses
        return stubborn;
    }

    @Test
    @Timeout(30)
    void unlimitedRestart_whoseStartThrows_leavesTimeForOthers_andWaitsLongerAndLonger() {
        spawnStubborn(ActorSettings.DEFAULT);
        Fragile other = spawn(Supervision.RESUME);
        assertThat(test.get(other.count())).isEqualTo(1);
        instances = 0;
        test.advance(Duration.ofMillis(9));
        assertThat(instances).isZero();
        test.advance(Duration.ofMillis(1));
        assertThat(instances).isOne();
        test.advance(Duration.ofMillis(20));
        assertThat(instances).isEqualTo(2);
        test.advance(Duration.ofMillis(39));
        assertThat(instances).isEqualTo(2);
        test.advance(Duration.ofMillis(1));
        assertThat(instances).isEqualTo(3);
        test.advance(Duration.ofMillis(80 + 160 + 320 + 640 + 1_280 + 2_560 + 5_120));
        assertThat(instances).isEqualTo(3 + 7);
        test.advance(Duration.ofSeconds(100)); // no pause is longer than 10 s
        assertThat(instances).isEqualTo(10 + 10);
        assertThat(test.takeProblems()).hasSizeGreaterThan(20);
    }

    @Test
    @Timeout(30)
    void callsOfAnActorThatWaitsForItsRestart_areServedInOrder_whenItHasStarted() {
        Stubborn stubborn = spawnStubborn(ActorSettings.DEFAULT);
        for (int number = 1; number <= 3; number++) {
            stubborn.note(number);
        }
        test.crank();
        assertThat(log).isEmpty();
        refuses = false;
        test.run(() -> {
            for (int number = 4; number <= 6; number++) {
                stubborn.note(number);
            }
            test.clock().advance(Duration.ofMillis(10)); // due while these are in the mailbox
        });
        assertThat(log).containsExactly("note 1", "note 2", "note 3", "note 4", "note 5", "note 6");
        stubborn.note(7);
        stubborn.fail();
        stubborn.note(8);
        test.crank();
        assertThat(log).endsWith("note 6", "note 7", "note 8");
        test.takeProblems();
    }

    @Test
    @Timeout(30)
    void callsOfAnActorThatWaitsForItsRestart_areRejected_whenItStops() {
        Stubborn stubborn = spawnStubborn(ActorSettings.DEFAULT.withMailbox(2, MailboxBound.Overflow.DROP_OLDEST));
        stubborn.note(1);
        stubborn.note(2);
        test.crank();
        test.space().stop(stubborn);
        test.crank();
        assertThat(test.takeDeadLetters()).hasSize(2);
        test.advance(Duration.ofSeconds(10));
        assertThat(instances).isEqualTo(2);
        test.takeProblems();
    }

    @Test
    void failuresFarApart_areForgiven() {
        Fragile fragile = spawn(Supervision.restart(1, Duration.ofSeconds(10)));
        for (int i = 0; i < 5; i++) {
            fragile.fail();
            test.advance(Duration.ofSeconds(10));
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
        test.space().stop(fragile);
        test.crank();
        assertThat(test.space().whenStopped(fragile).isDone()).isTrue();
        assertThatThrownBy(() -> test.space().whenStopped("nobody")).hasMessageContaining("not a proxy");
    }

    @Test
    void settingsThatMakeNoSense_areRejected() {
        assertThatThrownBy(() -> Supervision.restart(-1, Duration.ofSeconds(1))).hasMessageContaining("limit is -1");
        assertThatThrownBy(() -> Supervision.restart(1, Duration.ZERO)).hasMessageContaining("window is PT0S");
    }

    @Test
    @Timeout(30)
    void stopInThePauseBeforeARestart_leavesNoTimer() {
        Stubborn stubborn = spawnStubborn(ActorSettings.DEFAULT);
        assertThat(test.space().metrics().timers()).isOne();
        test.space().stop(stubborn);
        test.crank();
        assertThat(test.space().metrics().timers()).isZero();
        test.takeProblems();
    }

    @Test
    @Timeout(30)
    void callsThatWereHeldBack_areServedBeforeTheStopThatCameAfterThem() {
        Stubborn stubborn = spawnStubborn(ActorSettings.DEFAULT);
        for (int number = 1; number <= 400; number++) {
            stubborn.note(number);
        }
        test.crank();
        refuses = false;
        test.run(() -> test.space().delay(Duration.ofMillis(10)).thenRun(() -> {
            test.space().stop(stubborn); // runs after 256 callbacks
            stubborn.note(401);
        }));
        test.advance(Duration.ofMillis(10));
        assertThat(log).hasSize(400).endsWith("note 400");
        assertThat(test.takeDeadLetters()).hasSize(1);
        test.takeProblems();
    }

    @Test
    @Timeout(30)
    void failureAmongCallsThatWereHeldBack_beforeAStop_letsItStopInsteadOfWaitingForARestart() {
        Stubborn stubborn = spawnStubborn(ActorSettings.DEFAULT);
        for (int number = 1; number <= 300; number++) {
            stubborn.note(number);
        }
        stubborn.fail();
        test.crank();
        refuses = false;
        var stopped = test.space().whenStopped(stubborn);
        test.run(() -> test.space().delay(Duration.ofMillis(10)).thenRun(() -> {
            refuses = true;
            test.space().stop(stubborn); // runs after 256 callbacks
        }));
        test.advance(Duration.ofMillis(10));
        assertThat(stopped.isDone()).isTrue();
        assertThat(log).hasSize(300);
        assertThat(test.space().metrics().timers()).isZero();
        test.takeProblems();
    }

    @Test
    @Timeout(30)
    void failedStartsInARow_reachTheLimit_thoughThePausesExceedTheWindow() {
        refuses = true;
        Stubborn stubborn = test.spawn(
                Stubborn.class,
                () -> new Stubborn(this),
                ActorSettings.DEFAULT.withSupervision(Supervision.restart(5, Duration.ofMillis(15))));
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
        var settings = ActorSettings.DEFAULT.withSupervision(supervision);
        test.run(() -> {
            var spawned = new AtomicReference<Stubborn>();
            try {
                Thread.ofPlatform()
                        .start(() ->
                                spawned.set(test.space().spawn(Stubborn.class, () -> new Stubborn(this), settings)))
                        .join();
            } catch (InterruptedException interrupted) {
                throw new IllegalStateException(interrupted);
            }
            spawned.get().note(7);
            spawned.get().note(8);
        });
        test.takeProblems();
    }

    @Test
    void callBeforeTheSpawnEntry_doesNotReachAnInstanceWhoseStartThrows() {
        callBeforeTheSpawnEntry(Supervision.STOP);
        assertThat(log).isEmpty();
        assertThat(test.takeDeadLetters()).hasSize(2);
    }

    @Test
    @Timeout(30)
    void callBeforeTheSpawnEntry_waitsForTheRestart_ifTheStartThrows() {
        callBeforeTheSpawnEntry(Supervision.restart(100, Duration.ofSeconds(10)));
        assertThat(log).isEmpty();
        refuses = false;
        test.advance(Duration.ofMillis(10));
        assertThat(log).containsExactly("note 7", "note 8");
        assertThat(instances).isEqualTo(3);
    }
}
