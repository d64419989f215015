package io.troupe.actor.promise;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Promises about promises about promises, and listeners that wait. */
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
}
