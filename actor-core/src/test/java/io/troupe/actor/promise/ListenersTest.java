package io.troupe.actor.promise;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Reachable;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.Node;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** What a promise that is not local knows about its listeners. */
@Timeout(60)
class ListenersTest {
    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    private Deferred<Integer> limitedBy(int limits, List<Promise<Integer>> limited) {
        var source = new Deferred<Integer>(test.space());
        for (int count = 0; count < limits; count++) {
            limited.add(source.orTimeout(Duration.ofSeconds(1)));
        }
        return source;
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 8, 9, 20})
    void promise_allOfWhoseTimeLimitsHavePassed_isGivenUp(int limits) {
        var limited = new ArrayList<Promise<Integer>>();
        var source = limitedBy(limits, limited);
        limited.forEach(each -> each.exceptionally(late -> 0));
        test.crank();
        assertThat(source.isGivenUp()).isFalse();
        test.advance(Duration.ofSeconds(1));
        assertThat(source.isGivenUp()).isTrue();
        source.thenAccept(value -> {});
        assertThat(source.isGivenUp()).isFalse();
        source.resolve(1);
        test.crank();
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 12})
    void promise_thatIsSettledWhileItsListenersAreAsked_isGivenUp(int listeners) {
        var source = new Deferred<Integer>(test.space());
        var asking = new boolean[1];
        for (int count = 0; count < listeners; count++) {
            BooleanSupplier isOver = () -> {
                if (asking[0]) {
                    source.resolve(1); // simulates another thread
                }
                return false;
            };
            source.register(new Listeners.Inline(() -> {}, isOver));
        }
        asking[0] = true;
        assertThat(source.isGivenUp()).isTrue();
    }

    @Test
    void rejectionAmongTheListenersOfATimeOut_isReported() {
        var limited = new ArrayList<Promise<Integer>>();
        var source = limitedBy(1, limited);
        var failure = new IllegalStateException("too late");
        limited.getFirst().register(new Listeners.Inline(() -> source.reject(failure), () -> false));
        test.advance(Duration.ofSeconds(1));
        test.advance(Duration.ofSeconds(1));
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem -> assertThat(problem.error()).isSameAs(failure));
    }

    @Test
    void rejectionOfAPromiseWithManyListeners_isReportedWithoutItsLock() {
        var lockHeld = new ArrayList<Boolean>();
        var listeners = new ArrayList<Node>();
        var promise = new Promise<Integer>() {
            @Override
            protected @Nullable Home home() {
                listeners.forEach(node -> lockHeld.add(Thread.holdsLock(node)));
                return EventLoop.homeOf(test.space());
            }
        };
        for (int count = 0; count < 20; count++) {
            promise.register(new Listeners.Inline(() -> {}, () -> false));
        }
        Reachable.from(promise).stream()
                .filter(Listeners.Many.class::isInstance)
                .forEach(each -> listeners.add((Node) each));
        assertThat(listeners).hasSize(1);
        promise.settleError(new IllegalStateException("failed"));
        assertThat(lockHeld).isNotEmpty().containsOnly(false);
    }

    @Test
    void answersOfOtherThreads_areNotKeptByAnIdleSpace() {
        var answer = new Deferred<byte[]>(test.space());
        test.run(() -> answer.thenAccept(value -> {}));
        answer.resolve(new byte[1_000]);
        test.crank();
        assertThat(Reachable.from(test.space()).stream().filter(Stage.class::isInstance))
                .isEmpty();
    }
}
