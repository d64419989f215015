package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class SupervisionTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();
    private final Deferred<String> later = new Deferred<>();
    private int instances;

    /** Counts, and fails when told to. */
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
    void restart_makesAFreshInstanceBehindTheSameProxy_andKeepsTheMailbox() {
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
    void moreFailuresThanTheLimit_stopTheActor_andItsWatchersHear() {
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
    void settingsThatMakeNoSense_areRefused() {
        assertThatThrownBy(() -> Supervision.restart(-1, Duration.ofSeconds(1))).hasMessageContaining("limit is -1");
        assertThatThrownBy(() -> Supervision.restart(1, Duration.ZERO)).hasMessageContaining("window is PT0S");
    }
}
