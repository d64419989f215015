package io.troupe.actor.promise;

import static io.troupe.actor.Concurrently.onAnotherThread;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.InTestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeoutException;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Where listeners run, which rejections are reported, and which promises are given up. */
@Timeout(60)
class PromiseHomeTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);

    private final Deferred<Integer> source = new Deferred<>(test.space());

    private static IllegalStateException broken() {
        return new IllegalStateException("broken");
    }

    // ---- where listeners run

    @Test
    void gathered_outside_belongsToTheSpaceOfItsParts() {
        var parts = List.of(source, new Deferred<Integer>(test.space()));
        Promise.all(parts).thenAccept(values -> log.add(values + " in " + ActorSpace.current()));
        parts.forEach(part -> part.resolve(7));
        assertThat(log).isEmpty();
        test.crank();
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
        test.crank();
        assertThat(log).containsExactly("first", "second", "third");
    }

    @Test
    void cancel_fromOutside_ofAPromiseMadeInside_arrivesWithTheNextTurn() {
        var made = new ArrayList<Promise<Integer>>();
        test.run(() -> made.add(source.thenApply(value -> value + 1)));
        Promise<Integer> inside = made.getFirst();
        assertThat(inside.cancel()).isTrue();
        test.crank();
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
        String progress = "promise after Slow.read(1) of Slow#1, which has begun it";
        assertThat(first.getFirst()).hasMessage("no answer to test-space within PT1S from " + progress);
        source.resolve(1);
        test.crank();
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
        test.crank();
        assertThat(source.isGivenUp()).isFalse();
        test.advance(SECOND);
        assertThat(source.isGivenUp()).isTrue();
        source.thenAccept(value -> {});
        assertThat(source.isGivenUp()).isFalse();
        source.resolve(1);
        test.crank();
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
        test.crank();
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
        test.crank();
        test.advance(SECOND.multipliedBy(2));
        assertThat(takeErrors()).containsExactly("broken");
    }

    @Test
    void failure_thatLosesARace_isNotReported() {
        var second = new Deferred<Integer>(test.space());
        test.run(() -> Promise.race(List.of(source, second)));
        source.resolve(1);
        second.reject(broken());
        test.advance(SECOND.multipliedBy(2));
        assertThat(test.takeProblems()).isEmpty();
    }
}
