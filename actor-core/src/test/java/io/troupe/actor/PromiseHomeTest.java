package io.troupe.actor;

import static io.troupe.actor.Concurrently.onAnotherThread;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntry;
import java.io.IOException;
import java.lang.ref.WeakReference;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeoutException;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Where listeners run, which rejections are reported, which promises are given up, and what promises retain. */
@Timeout(60)
class PromiseHomeTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final Duration HOUR = Duration.ofHours(1);

    private final Deferred<Integer> source = test.space().deferred();

    private static IllegalStateException broken() {
        return new IllegalStateException("broken");
    }

    // ---- where listeners run

    @Test
    void gathered_outside_belongsToTheSpaceOfItsParts() {
        var parts = List.of(source, test.space().<Integer>deferred());
        Promise.all(parts).thenAccept(values -> log.add(values + " in " + ActorSpace.current()));
        parts.forEach(part -> part.resolve(7));
        assertThat(log).isEmpty();
        test.runQueued();
        assertThat(log).containsExactly("[7, 7] in test-space");
    }

    @Test
    void listenerWithoutAHome_settledInASpace_hasATurnOfItsOwn() {
        var homeless = new Deferred<Integer>();
        homeless.thenAccept(value -> log.add("listener"));
        test.run(() -> {
            homeless.resolve(1);
            log.add("end of the turn");
        });
        assertThat(log).containsExactly("end of the turn", "listener");
    }

    @Test
    void listeners_ofAPromiseThatAnotherThreadSettlesBetweenThem_keepTheirOrder() {
        test.run(() -> {
            source.thenAccept(value -> log.add("first"));
            onAnotherThread(() -> source.resolve(1));
            source.thenAccept(value -> log.add("second"));
        });
        source.thenAccept(value -> log.add("third"));
        test.runQueued();
        assertThat(log).containsExactly("first", "second", "third");
    }

    @Test
    void cancel_fromOutside_ofAPromiseMadeInside_arrivesWithTheNextTurn() {
        var made = new ArrayList<Promise<Integer>>();
        test.run(() -> made.add(source.thenApply(value -> value + 1)));
        Promise<Integer> inside = made.getFirst();
        assertThat(inside.cancel()).isTrue();
        test.runQueued();
        assertThat(inside.isCancelled()).isTrue();
        assertThat(inside.cancel()).isFalse();
    }

    @Test
    void promiseThatFollowsItself_isRejected() {
        var promise = new Deferred<Integer>();
        promise.resolveFrom(promise);
        assertThat(promise.error()).isInstanceOf(IllegalStateException.class).hasMessageContaining("wait for itself");
    }

    // ---- time limits

    @Test
    void timeLimit_namesCallerRequestAndProgress() {
        interface Slow {
            Promise<Integer> read(int page);
        }
        Slow slow = test.spawn(Slow.class, () -> page -> source);
        var first = new ArrayList<@Nullable Throwable>();
        test.run(
                () -> slow.read(1).thenApply(text -> text).orTimeout(SECOND).handle((text, error) -> first.add(error)));
        test.advance(SECOND);
        String progress = "promise after Slow.read(int) of Slow#1, which has begun it";
        assertThat(first.getFirst()).hasMessage("no answer to test-space within PT1S from " + progress);
        source.resolve(1);
        test.runQueued();
    }

    private List<Promise<Integer>> limitedSource(int limits) {
        var limited = new ArrayList<Promise<Integer>>();
        for (int count = 0; count < limits; count++) {
            limited.add(source.orTimeout(SECOND));
        }
        return limited;
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 8, 9, 20})
    void promise_allOfWhoseTimeLimitsHavePassed_isGivenUp(int limits) {
        limitedSource(limits).forEach(each -> each.exceptionally(late -> 0));
        test.runQueued();
        assertThat(source.isGivenUp()).isFalse();
        test.advance(SECOND);
        assertThat(source.isGivenUp()).isTrue();
        source.thenAccept(value -> {});
        assertThat(source.isGivenUp()).isFalse();
        source.resolve(1);
        test.runQueued();
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 12})
    void promise_thatIsSettledWhileItsListenersAreAsked_isGivenUp(int listeners) {
        var asking = new boolean[1];
        BooleanSupplier isOver = () -> {
            if (asking[0]) {
                source.resolve(1); // simulates another thread
            }
            return false;
        };
        for (int count = 0; count < listeners; count++) {
            source.register(new Listeners.Inline(() -> {}, isOver));
        }
        asking[0] = true;
        assertThat(source.isGivenUp()).isTrue();
    }

    // ---- which rejections are reported

    @Test
    void gathered_andRejectedWithoutAListener_isReported() {
        test.run(() -> Promise.any(List.of(Promise.<Integer>failed(broken()))));
        test.runQueued();
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void timeLimit_withoutAListener_isReported() {
        test.run(() -> source.orTimeout(SECOND));
        test.advance(SECOND);
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem -> assertThat(problem.error()).isInstanceOf(TimeoutException.class));
    }

    @Test
    void rejectionAmongTheListenersOfATimeOut_isReported() {
        var failure = broken();
        limitedSource(1).getFirst().register(new Listeners.Inline(() -> source.reject(failure), () -> false));
        test.advance(SECOND);
        test.advance(SECOND);
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem -> assertThat(problem.error()).isSameAs(failure));
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void failure_thatComesAfterTheTimeLimit_isReported_unlessAnotherListenerReceivedIt(boolean another) {
        test.run(() -> {
            source.orTimeout(SECOND).exceptionally(tooLate -> 0);
            if (another) {
                source.exceptionally(error -> 1);
            }
        });
        test.advance(SECOND);
        assertThat(test.takeProblems()).isEmpty();
        test.run(() -> source.reject(broken()));
        test.advance(SECOND.multipliedBy(2));
        assertThat(takeErrors()).isEqualTo(another ? List.of() : List.of("broken"));
    }

    @Test
    void failure_thatComesAfterAGetThatTimedOut_isReported() {
        assertThatThrownBy(() -> source.get(Duration.ZERO)).isInstanceOf(TimeoutException.class);
        source.reject(broken());
        test.runQueued();
        test.advance(SECOND.multipliedBy(2));
        assertThat(takeErrors()).containsExactly("broken");
    }

    @Test
    void failure_thatLosesARace_isNotReported() {
        Deferred<Integer> second = test.space().deferred();
        test.run(() -> Promise.race(List.of(source, second)));
        source.resolve(1);
        second.reject(broken());
        test.advance(SECOND.multipliedBy(2));
        assertThat(test.takeProblems()).isEmpty();
    }

    // ---- what promises retain, and for how long

    private static long kept(Object root, Class<?> type) {
        return Reachable.from(root).stream().filter(type::isInstance).count();
    }

    private void settleSource() {
        source.resolve(1);
        test.runQueued();
    }

    /** The source, or a promise made of it that belongs to the space alone. */
    private Promise<Integer> longLived(boolean local) {
        var promises = new ArrayList<Promise<Integer>>();
        test.run(() -> promises.add(local ? source.thenApply(value -> value) : source));
        return promises.getFirst();
    }

    /** One race is always pending, so that the newest listener is always needed when the next one is registered. */
    private void overlappingRaces(Promise<Integer> longLived, int count) {
        var flying = new ArrayDeque<Deferred<Integer>>();
        for (int round = 0; round < count; round++) {
            Deferred<Integer> other = test.space().deferred();
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
        overlappingRaces(source, 10_000);
        assertThat(kept(source, Listeners.Follower.class)).isBetween(1L, 20L);
        settleSource();
    }

    @Test
    void overlappingRaces_onALocalPromise_leaveNoMoreThanAFewListeners() {
        Promise<Integer> local = longLived(true);
        test.run(() -> overlappingRaces(local, 10_000));
        assertThat(kept(local, Listeners.Follower.class)).isBetween(1L, 20L);
        settleSource();
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void manyListeners_someOfThemGone_allOthersRunInTheOrderOfTheirRegistration(boolean local) {
        Promise<Integer> promise = longLived(local);
        var ran = new ArrayList<Integer>();
        test.run(() -> {
            for (int number = 0; number < 1_000; number++) {
                int id = number;
                Promise<Integer> stage = promise.then(value -> ran.add(id));
                if (id % 3 != 0) {
                    stage.cancel();
                }
            }
        });
        settleSource();
        assertThat(ran).hasSize(334).isSorted().allMatch(id -> id % 3 == 0);
    }

    @Test
    void bodiesThatWaited_andWereCancelled_areRemoved() {
        for (int actor = 0; actor < 300; actor++) {
            Doer patient = test.spawn(Doer.class, Doer::new);
            patient.run(me -> test.space().sequential(source::await).exceptionally(stopped -> -1));
            test.runQueued();
            stop(patient);
        }
        source.then(value -> {});
        assertThat(kept(source, Listeners.Inline.class)).isLessThan(20);
        settleSource();
    }

    @Test
    void promiseThatLivesLong_keepsNothingOfThoseWhoGaveUp() {
        var races = new ArrayList<WeakReference<Promise<Integer>>>();
        for (int round = 0; round < 10; round++) {
            races.add(new WeakReference<>(Promise.race(List.of(source, Promise.of(round)))));
        }
        source.then(value -> {}); // the next registration removes dead listeners
        for (int attempt = 0; attempt < 50 && races.stream().anyMatch(race -> race.get() != null); attempt++) {
            System.gc();
        }
        assertThat(races).allMatch(race -> race.get() == null);
        settleSource();
    }

    @Test
    void futuresThatWereCancelled_areRemoved() {
        for (int count = 0; count < 1_000; count++) {
            source.toCompletableFuture().cancel(true);
        }
        source.then(value -> {});
        assertThat(kept(source, Listeners.Inline.class)).isLessThan(20);
        settleSource();
    }

    @Test
    void rejectionOfAPromiseWithManyListeners_isReportedWithoutItsLock() {
        var lockHeld = new ArrayList<Boolean>();
        var listeners = new ArrayList<QueueEntry>();
        var promise = new Promise<Integer>() {
            @Override
            protected @Nullable Home home() {
                listeners.forEach(node -> lockHeld.add(Thread.holdsLock(node)));
                return test.space().home();
            }
        };
        for (int count = 0; count < 20; count++) {
            promise.register(new Listeners.Inline(() -> {}, () -> false));
        }
        Reachable.from(promise).stream()
                .filter(Listeners.Many.class::isInstance)
                .forEach(each -> listeners.add((QueueEntry) each));
        assertThat(listeners).hasSize(1);
        promise.settleError(new IllegalStateException("failed"));
        assertThat(lockHeld).isNotEmpty().containsOnly(false);
    }

    @Test
    void answersOfOtherThreads_areNotKeptByAnIdleSpace() {
        Deferred<byte[]> answer = test.space().deferred();
        test.run(() -> answer.thenAccept(value -> {}));
        answer.resolve(new byte[1_000]);
        test.runQueued();
        assertThat(kept(test.space(), Stage.class)).isZero();
    }

    @Test
    void retryForEver_keepsNothingOfTheTriesThatFailed() {
        var tries = new int[1];
        var last = new ArrayList<Deferred<Integer>>();
        Promise<Integer> retried = test.space().retry(Integer.MAX_VALUE, SECOND, () -> {
            if (++tries[0] % 1_000 != 0) {
                return Promise.failed(new IOException("try " + tries[0]));
            }
            last.add(new Deferred<>());
            return last.getLast();
        });
        for (int second = 0; second < 1_000; second++) {
            test.advance(SECOND);
        }
        assertThat(last).hasSize(1);
        assertThat(kept(last.getFirst(), Promise.class)).isBetween(1L, 10L);
        last.getFirst().resolve(7);
        assertThat(test.get(retried)).isEqualTo(7);
    }

    @Test
    void retryThatIsCancelled_triesNoMore_andTakesItsPauseBack() {
        var tries = new int[1];
        Promise<Integer> retried = test.space().retry(Integer.MAX_VALUE, SECOND, () -> {
            tries[0]++;
            return Promise.failed(new IOException("not yet"));
        });
        test.advance(SECOND);
        assertThat(tries[0]).isEqualTo(2);
        assertThat(retried.cancel()).isTrue();
        test.runQueued();
        assertThat(test.space().metrics().timers()).isZero();
        test.advance(SECOND.multipliedBy(10));
        assertThat(tries[0]).isEqualTo(2);
    }

    @Test
    void delayAndTimeLimit_thatAreCancelled_takeTheirTimersBack() {
        for (var made : List.<Supplier<Promise<?>>>of(() -> test.space().delay(HOUR), () -> source.orTimeout(HOUR))) {
            Promise<?> timed = made.get();
            test.runQueued();
            assertThat(test.space().metrics().timers()).isEqualTo(1);
            timed.cancel();
            test.runQueued();
            assertThat(test.space().metrics().timers()).isZero();
        }
    }

    private record Ballast(String name) implements Consumer<Integer> {
        @Override
        public void accept(Integer value) {}
    }

    @Test
    void stageThatIsSettled_keepsNoFunction() {
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
        settleSource();
        assertThat(stages).allMatch(Promise::isDone);
        assertThat(stages).allMatch(stage -> kept(stage, Ballast.class) == 0);
    }

    @Test
    void queueThatIsIdle_keepsNoNode() {
        var queue = new EntryQueue();
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
