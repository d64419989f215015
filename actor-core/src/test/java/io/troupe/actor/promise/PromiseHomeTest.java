package io.troupe.actor.promise;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.testkit.TestSpace;
import java.lang.ref.WeakReference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Where listeners run, which rejections are reported, and what a promise retains. */
class PromiseHomeTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void gathered_outside_belongsToTheSpaceOfItsParts() {
        var parts = List.of(new Deferred<Integer>(test.space()), new Deferred<Integer>(test.space()));
        Promise.all(parts).thenAccept(values -> log.add(values + " in " + ActorSpace.current()));
        parts.forEach(part -> part.resolve(7));
        assertThat(log).isEmpty();
        test.crank();
        assertThat(log).containsExactly("[7, 7] in test-space");
    }

    @Test
    void gathered_andRejectedWithoutAListener_isReported() {
        test.run(() -> Promise.any(List.of(Promise.<Integer>failed(new IllegalStateException("broken")))));
        test.crank();
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void timeLimit_withoutAListener_isReported() {
        var never = new Deferred<String>(test.space());
        test.run(() -> never.orTimeout(Duration.ofSeconds(1)));
        test.advance(Duration.ofSeconds(1));
        assertThat(test.takeProblems())
                .hasSize(1)
                .first()
                .satisfies(problem -> assertThat(problem.error()).isInstanceOf(TimeoutException.class));
    }

    @Test
    void timeLimit_thatIsCancelled_takesItsTimerBack() {
        var never = new Deferred<String>(test.space());
        Promise<String> limited = never.orTimeout(Duration.ofHours(1));
        test.crank();
        assertThat(test.space().metrics().timers()).isEqualTo(1);
        limited.cancel();
        test.crank();
        assertThat(test.space().metrics().timers()).isZero();
    }

    @Test
    void timeLimit_namesCallerRequestAndProgress() {
        interface Slow {
            Promise<String> read(int page);
        }
        var pages = new Deferred<String>(test.space());
        Slow slow = test.spawn(Slow.class, () -> page -> pages);
        var first = new ArrayList<@Nullable Throwable>();
        test.run(() -> slow.read(1)
                .thenApply(text -> text)
                .orTimeout(Duration.ofSeconds(1))
                .handle((text, error) -> first.add(error)));
        test.advance(Duration.ofSeconds(1));
        assertThat(first.getFirst())
                .hasMessage(
                        "no answer to test-space within PT1S from promise after Slow.read(1) of Slow#1, which has begun it");
        pages.resolve("");
        test.crank();
    }

    @Test
    void listenersWithoutAHome_runOneAfterTheOther_inAChainOfAnyLength() {
        var source = new Deferred<Integer>();
        Promise<Integer> end = source;
        for (int link = 0; link < 100_000; link++) {
            end = end.thenApply(value -> value + 1);
        }
        source.resolve(0);
        assertThat(end.getNow()).isEqualTo(100_000);
    }

    @Test
    void listenerWithoutAHome_settledInASpace_hasATurnOfItsOwn() {
        var source = new Deferred<Integer>();
        source.thenAccept(value -> log.add("listener"));
        test.run(() -> {
            source.resolve(1);
            log.add("end of the turn");
        });
        assertThat(log).containsExactly("end of the turn", "listener");
    }

    @Test
    void promiseThatLivesLong_keepsNothingOfThoseWhoGaveUp() throws InterruptedException {
        var longLived = new Deferred<Object>(test.space());
        var races = new ArrayList<WeakReference<Promise<Object>>>();
        for (int round = 0; round < 10; round++) {
            races.add(new WeakReference<>(Promise.race(List.of(longLived, Promise.<Object>of(round)))));
        }
        longLived.then(value -> {}); // the next registration removes dead listeners
        for (int attempt = 0; attempt < 50 && races.stream().anyMatch(race -> race.get() != null); attempt++) {
            System.gc();
        }
        assertThat(races).allMatch(race -> race.get() == null);
        longLived.resolve(1);
        test.crank();
    }

    @Test
    void listeners_ofAPromiseThatAnotherThreadSettlesBetweenThem_keepTheirOrder() {
        var source = new Deferred<Integer>(test.space());
        test.run(() -> {
            source.thenAccept(value -> log.add("first"));
            settleElsewhere(source);
            source.thenAccept(value -> log.add("second"));
        });
        source.thenAccept(value -> log.add("third"));
        test.crank();
        assertThat(log).containsExactly("first", "second", "third");
    }

    private static void settleElsewhere(Deferred<Integer> promise) {
        var other = Thread.ofPlatform().start(() -> promise.resolve(1));
        try {
            other.join();
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }

    @Test
    void promiseThatFollowsItself_isRejected() {
        var promise = new Deferred<Integer>();
        promise.resolveFrom(promise);
        assertThat(promise.error()).isInstanceOf(IllegalStateException.class).hasMessageContaining("wait for itself");
    }

    @Test
    void cancel_fromOutside_ofAPromiseMadeInside_arrivesWithTheNextTurn() {
        var made = new ArrayList<Promise<Integer>>();
        var source = new Deferred<Integer>(test.space());
        test.run(() -> made.add(source.thenApply(value -> value + 1)));
        Promise<Integer> inside = made.getFirst();
        assertThat(inside.cancel()).isTrue();
        test.crank();
        assertThat(inside.isCancelled()).isTrue();
        assertThat(inside.cancel()).isFalse();
    }

    @Test
    void failure_thatComesAfterTheTimeLimit_isReported_unlessAnotherListenerReceivedIt() {
        for (boolean another : new boolean[] {false, true}) {
            var late = new Deferred<String>(test.space());
            test.run(() -> {
                late.orTimeout(Duration.ofSeconds(1)).exceptionally(error -> "too late");
                if (another) {
                    late.exceptionally(error -> "heard");
                }
            });
            test.advance(Duration.ofSeconds(1));
            assertThat(test.takeProblems()).isEmpty();
            test.run(() -> late.reject(new IllegalStateException("broken")));
            test.advance(Duration.ofSeconds(2));
            assertThat(test.takeProblems())
                    .extracting(problem -> problem.error().getMessage())
                    .isEqualTo(another ? List.of() : List.of("broken"));
        }
    }

    @Test
    void failure_thatComesAfterAGetThatTimedOut_isReported() throws InterruptedException {
        var late = new Deferred<String>(test.space());
        assertThatThrownBy(() -> late.get(Duration.ZERO)).isInstanceOf(TimeoutException.class);
        late.reject(new IllegalStateException("broken"));
        test.crank();
        test.advance(Duration.ofSeconds(2));
        assertThat(test.takeProblems())
                .extracting(problem -> problem.error().getMessage())
                .containsExactly("broken");
    }

    @Test
    void failure_thatLosesARace_isNotReported() {
        var first = new Deferred<String>(test.space());
        var second = new Deferred<String>(test.space());
        test.run(() -> Promise.race(List.of(first, second)));
        first.resolve("first");
        second.reject(new IllegalStateException("second"));
        test.advance(Duration.ofSeconds(2));
        assertThat(test.takeProblems()).isEmpty();
    }
}
