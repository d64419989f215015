package io.troupe.actor.promise;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.Disabled;
import org.junit.jupiter.api.Test;

/** Promises about promises about promises, and listeners that wait. */
class PromiseDepthTest {
    @Test
    @Disabled("a relay settles the next promise on the stack of the one before")
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
    @Disabled("the inner listener waits in the line of its own thread, which waits for it")
    void get_inAListenerOutsideEverySpace_seesWhatIsSettled() {
        Promise<Integer> outer = Promise.of(1).thenApply(one -> {
            try {
                return Promise.of(2).thenApply(two -> one + two).get(Duration.ofSeconds(2));
            } catch (Exception failed) {
                throw new IllegalStateException(failed);
            }
        });
        assertThat(outer.error()).isNull();
        assertThat(outer.getNow()).isEqualTo(3);
    }
}
