package io.troupe.actor.promise;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.TimeoutException;
import org.junit.jupiter.api.Test;

/** Deep chains of promises, and listeners that wait. */
class PromiseDepthTest {
    @Test
    void all_ofAnAllOfAnAll_mayBeOfAnyDepth() {
        var first = new Deferred<Object>();
        Promise<?> last = first;
        for (int depth = 0; depth < 100_000; depth++) {
            last = Promise.all(List.of(last));
        }
        first.resolve("done");
        assertThat(last.isDone()).isTrue();
    }

    @Test
    void get_inAListenerOutsideEverySpace_throwsAndNamesTheAlternative() {
        Promise<Integer> outer = Promise.of(1).thenApply(one -> {
            try {
                return Promise.of(2).thenApply(two -> one + two).get(Duration.ofSeconds(2));
            } catch (Exception failed) {
                throw new IllegalStateException(failed);
            }
        });
        assertThat(outer.error()).hasRootCauseInstanceOf(IllegalStateException.class);
        assertThat(outer.error()).hasMessageContaining("get() in a listener");
    }

    private static Promise<Integer> chain(Promise<Integer> first, int length) {
        Promise<Integer> last = first;
        for (int link = 0; link < length; link++) {
            last = last.thenApply(value -> value + 1);
        }
        return last;
    }

    @Test
    void promiseBehindManyStages_canBeLimitedCancelledAndNamed_andItsTextIsShort() {
        try (var test = new TestSpace()) {
            var source = new Deferred<Integer>(test.space());
            var limited = new ArrayList<Promise<Integer>>();
            test.run(() -> limited.add(chain(source, 50_000).orTimeout(Duration.ofSeconds(1))));
            Promise<Integer> cancelled = chain(source, 50_000);
            limited.getFirst().exceptionally(error -> 0);
            test.advance(Duration.ofSeconds(1));
            assertThat(limited.getFirst().error())
                    .isInstanceOf(TimeoutException.class)
                    .satisfies(error -> assertThat(error.getMessage()).hasSizeLessThan(400));
            assertThat(cancelled.cancel()).isTrue();
            assertThat(cancelled.isCancelled()).isTrue();
            assertThat(cancelled.error().getMessage()).hasSizeLessThan(400);
            source.resolve(0);
            test.crank();
        }
    }

    @Test
    void manyTimeLimits_onTopOfEachOther_areSettledAndNamed() {
        try (var test = new TestSpace()) {
            var source = new Deferred<Integer>(test.space());
            Promise<Integer> last = source;
            for (int limit = 0; limit < 20_000; limit++) {
                last = last.orTimeout(Duration.ofSeconds(30 + limit));
            }
            test.advance(Duration.ofSeconds(30));
            assertThat(test.error(last)).hasMessageContaining("within PT30S from promise");
            assertThat(last.toString()).hasSizeLessThan(400);
        }
    }

    @Test
    void longChain_isSettledAndRejected_inASpaceAndOutside() {
        try (var test = new TestSpace()) {
            for (ActorSpace home : Arrays.asList(test.space(), null)) {
                var fulfilled = new Deferred<Integer>(home);
                Promise<Integer> value = chain(fulfilled, 100_000);
                fulfilled.resolve(0);
                var rejected = new Deferred<Integer>(home);
                Promise<Integer> error = chain(rejected, 100_000);
                rejected.reject(new IllegalStateException("broken"));
                test.crank();
                assertThat(value.getNow()).isEqualTo(100_000);
                assertThat(test.error(error)).hasMessage("broken");
            }
        }
    }

    @Test
    void text_ofAChain_namesWhatItWaitsFor_andHowFarThatIs() {
        try (var test = new TestSpace()) {
            var source = new Deferred<Integer>(test.space());
            assertThat(chain(source, 2)).hasToString("promise after promise after promise");
            assertThat(chain(source.orTimeout(Duration.ofSeconds(5)), 1).orTimeout(Duration.ofSeconds(7)))
                    .hasToString("promise after promise within PT5S within PT7S");
            assertThat(chain(source, 50)).asString().endsWith("promise after 42 others after promise");
            assertThat(chain(source, 500)).asString().endsWith("promise after more than 92 others");
            source.resolve(0);
            test.crank();
        }
    }
}
