package io.troupe.actor.promise;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.Reachable;
import io.troupe.actor.internal.loop.NodeQueue;
import io.troupe.actor.testkit.TestSpace;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** What promises retain, and for how long. */
class PromiseMemoryTest {
    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    private static long kept(Object root, Class<?> type) {
        return Reachable.from(root).stream().filter(type::isInstance).count();
    }

    /** One race is always pending, so that the newest listener is always needed when the next one is registered. */
    private void overlappingRaces(Promise<Integer> longLived, int count) {
        var flying = new ArrayDeque<Deferred<Integer>>();
        for (int round = 0; round < count; round++) {
            var other = new Deferred<Integer>(test.space());
            flying.add(other);
            Promise.race(List.of(longLived, other));
            if (flying.size() > 3) {
                flying.remove().resolve(round);
            }
        }
        flying.forEach(other -> other.resolve(-1));
    }

    @Test
    void overlappingRaces_onASharedPromise_leaveNoMoreThanAFewListeners() {
        var longLived = new Deferred<Integer>(test.space());
        overlappingRaces(longLived, 10_000);
        assertThat(kept(longLived, Listeners.Follower.class)).isBetween(1L, 20L);
        longLived.resolve(1);
        test.crank();
    }

    @Test
    void overlappingRaces_onALocalPromise_leaveNoMoreThanAFewListeners() {
        var source = new Deferred<Integer>(test.space());
        var local = new ArrayList<Promise<Integer>>();
        test.run(() -> {
            local.add(source.thenApply(value -> value));
            overlappingRaces(local.getFirst(), 10_000);
        });
        assertThat(kept(local.getFirst(), Listeners.Follower.class)).isBetween(1L, 20L);
        source.resolve(1);
        test.crank();
    }

    @Test
    void manyListeners_someOfThemGone_allOthersRunInTheOrderOfTheirRegistration() {
        for (boolean local : new boolean[] {false, true}) {
            var source = new Deferred<Integer>(test.space());
            var log = new ArrayList<Integer>();
            test.run(() -> {
                Promise<Integer> promise = local ? source.thenApply(value -> value) : source;
                for (int number = 0; number < 1_000; number++) {
                    int id = number;
                    Promise<Integer> stage = promise.then(value -> log.add(id));
                    if (id % 3 != 0) {
                        stage.cancel();
                    }
                }
            });
            source.resolve(1);
            test.crank();
            assertThat(log).hasSize(334).isSorted().allMatch(id -> id % 3 == 0);
        }
    }

    /** Has a body that waits for ever. */
    public static class Patient extends Actor {
        private final Promise<Integer> source;

        Patient(Promise<Integer> source) {
            this.source = source;
        }

        @Override
        protected void started() {
            space().sequential(source::await).exceptionally(stopped -> -1);
        }
    }

    @Test
    void bodiesThatWaited_andWereCancelled_areRemoved() {
        var longLived = new Deferred<Integer>(test.space());
        for (int actor = 0; actor < 300; actor++) {
            Patient patient = test.spawn(Patient.class, () -> new Patient(longLived));
            test.space().stop(patient);
            test.crank();
        }
        longLived.then(value -> {});
        assertThat(kept(longLived, Listeners.Inline.class)).isLessThan(20);
        longLived.resolve(1);
        test.crank();
    }

    @Test
    void retryForEver_keepsNothingOfTheTriesThatFailed() {
        var tries = new int[1];
        var last = new ArrayList<Deferred<Integer>>();
        Promise<Integer> retried = test.space().retry(Integer.MAX_VALUE, Duration.ofSeconds(1), () -> {
            if (++tries[0] % 1_000 != 0) {
                return Promise.failed(new IOException("try " + tries[0]));
            }
            last.add(new Deferred<>());
            return last.getLast();
        });
        for (int second = 0; second < 1_000; second++) {
            test.advance(Duration.ofSeconds(1));
        }
        assertThat(last).hasSize(1);
        assertThat(kept(last.getFirst(), Promise.class)).isBetween(1L, 10L);
        last.getFirst().resolve(7);
        assertThat(test.get(retried)).isEqualTo(7);
    }

    @Test
    void retryThatIsCancelled_triesNoMore_andTakesItsPauseBack() {
        var tries = new int[1];
        Promise<Integer> retried = test.space().retry(Integer.MAX_VALUE, Duration.ofSeconds(1), () -> {
            tries[0]++;
            return Promise.failed(new IOException("not yet"));
        });
        test.advance(Duration.ofSeconds(1));
        assertThat(tries[0]).isEqualTo(2);
        assertThat(retried.cancel()).isTrue();
        test.crank();
        assertThat(test.space().metrics().timers()).isZero();
        test.advance(Duration.ofSeconds(10));
        assertThat(tries[0]).isEqualTo(2);
    }

    @Test
    void delayThatIsCancelled_takesItsTimerBack() {
        Promise<?> delay = test.space().delay(Duration.ofHours(1));
        test.crank();
        assertThat(test.space().metrics().timers()).isEqualTo(1);
        delay.cancel();
        test.crank();
        assertThat(test.space().metrics().timers()).isZero();
    }

    private record Ballast(String name) implements Consumer<Integer> {
        @Override
        public void accept(Integer value) {}
    }

    @Test
    void stageThatIsSettled_keepsNoFunction() {
        var source = new Deferred<Integer>(test.space());
        var ballast = new Ballast("8 MB");
        List<Promise<?>> stages = List.of(
                source.then(ballast),
                source.thenAccept(ballast),
                source.thenApply(value -> ballast.name()),
                source.handle((value, error) -> ballast.name()),
                source.whenComplete((value, error) -> ballast.accept(value)),
                source.thenCompose(value -> Promise.of(ballast.name().length())),
                source.exceptionallyCompose(error -> Promise.of(ballast.name().length())));
        assertThat(stages).allMatch(stage -> kept(stage, Ballast.class) == 1);
        source.resolve(1);
        test.crank();
        assertThat(stages).allMatch(Promise::isDone);
        assertThat(stages).allMatch(stage -> kept(stage, Ballast.class) == 0);
    }

    @Test
    void queueThatIsIdle_keepsNoNode() {
        var queue = new NodeQueue();
        for (int round = 0; round < 3; round++) {
            var first = new Listeners.Inline(() -> {}, () -> false);
            var second = new Listeners.Inline(() -> {}, () -> false);
            queue.offer(first);
            assertThat(queue.poll()).isSameAs(first);
            assertThat(kept(queue, Listeners.Inline.class)).isEqualTo(1);
            queue.forgetLast();
            queue.forgetLast();
            assertThat(kept(queue, Listeners.Inline.class)).isZero();
            assertThat(queue.isEmpty()).isTrue();
            queue.offer(first);
            queue.offer(second);
            queue.forgetLast();
            assertThat(queue.size()).isEqualTo(2);
            assertThat(queue.poll()).isSameAs(first);
            queue.forgetLast();
            assertThat(queue.poll()).isSameAs(second);
            assertThat(queue.poll()).isNull();
        }
    }
}
