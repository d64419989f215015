package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The services of a space: delays, retries, blocking work. */
class SpaceServicesTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void delay_followsTheSpacesClock() {
        Promise<?> delay = test.space().delay(Duration.ofSeconds(2));
        test.advance(Duration.ofMillis(1_999));
        assertThat(delay.isDone()).isFalse();
        test.advance(Duration.ofMillis(1));
        assertThat(delay.isDone()).isTrue();
    }

    @Test
    void retry_pausesBetweenItsTries_andAnswersTheFirstValue() {
        var tries = new int[1];
        test.run(() -> test.space()
                .retry(5, Duration.ofSeconds(1), () -> {
                    log.add("try " + ++tries[0] + " at " + test.clock().nanos() / 1_000_000_000);
                    return tries[0] < 3 ? Promise.<String>failed(new IOException("not yet")) : Promise.of("done");
                })
                .thenAccept(log::add));
        test.advance(Duration.ofSeconds(1));
        test.advance(Duration.ofSeconds(1));
        assertThat(log).containsExactly("try 1 at 0", "try 2 at 1", "try 3 at 2", "done");
    }

    @Test
    void retry_answersTheLastError_alsoOfAnAttemptThatThrows() {
        var tries = new int[1];
        test.run(() -> test.space()
                .<String>retry(2, Duration.ofSeconds(1), () -> {
                    throw new IllegalStateException("failure " + ++tries[0]);
                })
                .exceptionally(error -> {
                    log.add(error.getMessage());
                    return null;
                }));
        test.advance(Duration.ofSeconds(1));
        assertThat(log).containsExactly("failure 2");
        assertThatThrownBy(() -> test.space().retry(0, Duration.ZERO, () -> Promise.of(1)))
                .hasMessageContaining("tries is 0");
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void offload_runsBlockingWorkElsewhere_andItsListenerHere() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("busy"))) {
            var where = new Deferred<String>();
            space.execute(() -> space.offload(() -> Thread.currentThread().isVirtual())
                    .then(virtual -> {
                        where.resolve(
                                virtual + " then " + Thread.currentThread().getName());
                    }));
            assertThat(where.get(Duration.ofSeconds(30))).isEqualTo("true then busy");
            Promise<String> failing = space.offload(() -> {
                throw new IOException("disk");
            });
            assertThatThrownBy(() -> failing.get(Duration.ofSeconds(30)))
                    .isInstanceOf(IOException.class)
                    .hasMessage("disk");
        }
    }

    @Test
    @SuppressWarnings("NullAway") // passes null on purpose
    void nullArgument_isRejectedAtOnce_byName() {
        ActorSpace space = test.space();
        assertThatThrownBy(() -> space.delay(null)).hasMessage("duration");
        assertThatThrownBy(() -> space.retry(1, null, () -> Promise.of(1))).hasMessage("pause");
        assertThatThrownBy(() -> space.retry(1, Duration.ZERO, null)).hasMessage("attempt");
        assertThatThrownBy(() -> space.whenStopped(null)).hasMessage("proxy");
        test.run(() -> {
            assertThatThrownBy(() -> space.repeatWhile(() -> false, (Runnable) null))
                    .hasMessage("body");
            log.add("checked");
        });
        assertThat(log).containsExactly("checked");
    }
}
