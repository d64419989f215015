package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Corner cases of the contract. */
@Timeout(30)
class EdgesTest {
    private final List<String> log = new ArrayList<>();

    /** Answers later, or never. */
    public interface Worker {
        Promise<Integer> ask(int number);

        void take(int number);
    }

    private static final class Never implements Worker {
        @Override
        public Promise<Integer> ask(int number) {
            return new Deferred<>();
        }

        @Override
        public void take(int number) {}
    }

    @Test
    void stallLimit_longerThanNanosecondsCanCount_spaceLives() throws Exception {
        var space = ActorSpace.create(
                SpaceSettings.named("patient").withOnStall(ChronoUnit.FOREVER.getDuration(), stall -> {}));
        var served = new CountDownLatch(1);
        space.execute(served::countDown);
        assertThat(served.await(3, TimeUnit.SECONDS)).isTrue();
        space.close();
    }

    @Test
    void get_forEver_waits() throws Exception {
        var space = ActorSpace.create(SpaceSettings.named("waited-for"));
        try (space) {
            Promise<Integer> answer = space.sequential(() -> 1);
            assertThat(answer.get(ChronoUnit.FOREVER.getDuration())).isEqualTo(1);
        }
    }

    @Test
    void timeout_ofARequestThatTookTheOldestOnesPlace_reportsThatItHasNotBegun() {
        var test = new TestSpace();
        var error = new AtomicReference<Throwable>();
        Worker worker = test.space()
                .spawn(Worker.class, Never::new, ActorSettings.DEFAULT.withMailbox(1, Overflow.DROP_OLDEST));
        test.crank();
        test.run(() -> {
            for (int before = 0; before < 600; before++) {
                test.space().execute(() -> {}); // more than one pass runs
            }
            worker.ask(1).exceptionally(dropped -> 0);
            worker.ask(2).orTimeout(Duration.ZERO).exceptionally(late -> {
                error.set(late);
                return 0;
            });
        });
        assertThat(error.get()).hasMessageContaining("which has not begun it");
        test.close();
    }

    @Test
    void timeout_behindALongQueue_countsItNoFurtherThanAThousand() {
        var test = new TestSpace();
        var error = new AtomicReference<Throwable>();
        Worker worker = test.spawn(Worker.class, Never::new);
        test.run(() -> {
            for (int before = 0; before < 3_000; before++) {
                worker.take(before);
            }
            worker.ask(1).orTimeout(Duration.ZERO).exceptionally(late -> {
                error.set(late);
                return 0;
            });
        });
        assertThat(error.get()).hasMessageEndingWith("from Worker.ask(1) of Worker#1, where more than 1000 calls wait");
        test.close();
    }

    @Test
    void completableFuture_whatFollowsInIt_isNotOnBehalfOfTheLastActor() {
        var test = new TestSpace();
        var promise = new AtomicReference<Promise<Integer>>();
        var deferred = new Deferred<Integer>();
        test.run(() -> promise.set(deferred.thenApply(one -> one)));
        Worker other = test.spawn(Worker.class, Never::new);
        deferred.resolve(1);
        test.crank();
        other.take(1);
        CompletableFuture<Integer> future = promise.get().toCompletableFuture();
        future.thenAccept(one -> test.space().delay(Duration.ofSeconds(1)).thenRun(() -> log.add("alarm")));
        test.crank();
        test.space().stop(other);
        test.crank();
        test.advance(Duration.ofSeconds(2));
        assertThat(log).containsExactly("alarm");
        test.close();
    }

    /** Has a field that refers to itself. */
    public static class Selfish extends Actor {
        public Promise<String> name() {
            return Promise.of(self().toString());
        }
    }

    @Test
    void factory_answersTheSameObjectForTwoActors_firstKeepsItsOwnSelf() {
        var test = new TestSpace();
        var one = new Selfish();
        Selfish first = test.spawn(Selfish.class, () -> one);
        test.spawn(Selfish.class, () -> one); // rejecting it would also be correct
        test.takeProblems();
        assertThat(test.get(first.name())).isEqualTo(first.toString());
        test.close();
    }
}
