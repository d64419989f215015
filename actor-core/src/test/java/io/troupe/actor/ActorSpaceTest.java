package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(30)
class ActorSpaceTest extends InTestSpace {
    private static final Duration FOREVER = ChronoUnit.FOREVER.getDuration();

    private final Doer doer = test.spawn(Doer.class, Doer::new);

    @Test
    void listener_ofAStoppedActor_isNotCalled() {
        var promise = new Deferred<String>();
        doer.run(me -> promise.thenAccept(log::add));
        stop(doer);
        promise.resolve("late");
        test.crank();
        assertThat(log).isEmpty();
    }

    private Promise<Integer> countDown(int from) {
        return from == 0
                ? Promise.of(0)
                : Promise.of(1).thenCompose(one -> countDown(from - one)).thenApply(depth -> depth + 1);
    }

    @Test
    void recursionThroughPromises_mayBeOfAnyDepth() {
        assertThat(values(doer.ask(me -> countDown(100_000)))).containsExactly(100_000);
    }

    private void pass(int left) {
        log.add("pass " + left);
        if (left > 0) {
            doer.run(me -> pass(left - 1));
        }
    }

    @Test
    void onIdle_waitsForEverythingThatComesOfWhatWaits() {
        test.space().onIdle(() -> log.add("idle"));
        doer.run(me -> pass(2));
        test.crank();
        assertThat(log).containsExactly("pass 2", "pass 1", "pass 0", "idle");
    }

    @Test
    void spacesCrankedInsideEachOther_knowWhoseTurnItIs() {
        try (var inner = new TestSpace()) {
            var seen = new ArrayList<ActorSpace>();
            test.run(() -> {
                seen.add(ActorSpace.current());
                inner.run(() -> seen.add(ActorSpace.current()));
                seen.add(ActorSpace.current());
            });
            assertThat(seen).containsExactly(test.space(), inner.space(), test.space());
            assertThat(ActorSpace.current()).isNull();
        }
    }

    @Test
    void crank_ofASpaceWithAThread_isRejected() {
        try (var space = ActorSpace.create(SpaceSettings.named("threaded"))) {
            assertThatThrownBy(space::crank)
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageContainingAll("threaded", "thread of its own");
        }
    }

    @Test
    void globalSpace_cannotBeClosed() {
        assertThatThrownBy(() -> ActorSpace.global().close()).hasMessageContaining("cannot be closed");
    }

    @Test
    void stallLimitAndGet_longerThanNanosecondsCanCount_work() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("patient").withOnStall(FOREVER, stall -> {}))) {
            var served = new CountDownLatch(1);
            space.execute(served::countDown);
            assertThat(served.await(3, TimeUnit.SECONDS)).isTrue();
            assertThat(space.sequential(() -> 1).get(FOREVER)).isEqualTo(1);
        }
    }

    @Test
    void completableFuture_whatFollowsInIt_isNotOnBehalfOfTheLastActor() {
        var promise = new AtomicReference<Promise<Integer>>();
        var deferred = new Deferred<Integer>();
        test.run(() -> promise.set(deferred.thenApply(one -> one)));
        deferred.resolve(1);
        test.crank();
        doer.run(me -> {});
        promise.get()
                .toCompletableFuture()
                .thenAccept(one -> test.space().delay(Duration.ofSeconds(1)).thenRun(() -> log.add("alarm")));
        test.crank();
        stop(doer);
        test.advance(Duration.ofSeconds(2));
        assertThat(log).containsExactly("alarm");
    }

    @Test
    void factory_answersTheSameObjectForTwoActors_firstKeepsItsOwnSelf() {
        var one = new Doer();
        Doer first = test.spawn(Doer.class, () -> one);
        test.spawn(Doer.class, () -> one); // rejecting it would also be correct
        test.takeProblems();
        assertThat(values(first.ask(me -> Promise.of(me.self().toString())))).containsExactly(first.toString());
    }

    @Test
    void runningSpace_whoseWakerCouldNotUnparkIt_isNotTakenForAsleep_andIsWokenAgain() {
        var lifeline = new IdleStrategy();
        lifeline.noteNotWoken();
        assertThat(lifeline.isAsleep()).isFalse();
        assertThat(lifeline.wake()).isTrue();
        assertThat(lifeline.phase).isZero();
        lifeline.close();
        lifeline.noteNotWoken();
        assertThat(lifeline.isClosed()).isTrue();
    }
}
