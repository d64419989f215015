package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeoutException;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Delays and time limits set by threads outside every space. */
@Tag("threads")
@Timeout(60)
class OutsideTimersTest {
    private static final Duration SOON = Duration.ofMillis(10);
    private static final Duration LONG = Duration.ofHours(1);
    private static final Duration PATIENCE = Duration.ofSeconds(50);

    /** Answers when the test allows it. */
    public interface Sleeper {
        Promise<String> ask();
    }

    private static Sleeper spawnSleeper(ActorSpace space, CountDownLatch wake) {
        return space.spawn(Sleeper.class, () -> () -> {
            try {
                wake.await();
            } catch (InterruptedException interrupted) {
                throw new IllegalStateException(interrupted);
            }
            return Promise.of("awake");
        });
    }

    @Test
    void stalledSpace_itsTimeLimitsAndDelays_endAllTheSame() throws Exception {
        var wake = new CountDownLatch(1);
        try (var space = ActorSpace.create(SpaceSettings.named("stalled"))) {
            Promise<String> asked = spawnSleeper(space, wake).ask();
            try {
                assertThatThrownBy(() -> asked.orTimeout(SOON).get(PATIENCE))
                        .isInstanceOf(TimeoutException.class)
                        .hasMessageContaining("within PT0.01S from Sleeper.ask() of Sleeper#1");
                space.delay(SOON).get(PATIENCE);
                assertThat(asked.isDone()).isFalse();
            } finally {
                wake.countDown();
            }
            assertThat(asked.get(PATIENCE)).isEqualTo("awake");
        }
    }

    @Test
    void listener_ofATimeLimitFromOutside_runsOnTheSpace() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("here"))) {
            Promise<String> thread = new Deferred<String>(space)
                    .orTimeout(SOON)
                    .exceptionally(late -> Thread.currentThread().getName());
            assertThat(thread.get(PATIENCE)).isEqualTo("here");
            assertThat(space.delay(SOON)
                            .thenApply(over -> Thread.currentThread().getName())
                            .get(PATIENCE))
                    .isEqualTo("here");
        }
    }

    @Test
    void manyTimeLimits_shareOneThread_andAreReleasedWhenTheirPromisesAreSettled() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("many"))) {
            var asked = new ArrayList<Deferred<Integer>>();
            var limited = new ArrayList<Promise<Integer>>();
            for (int number = 0; number < 10_000; number++) {
                var promise = new Deferred<Integer>(space);
                asked.add(promise);
                limited.add(promise.orTimeout(LONG));
            }
            assertThat(space.metrics().timers()).isEqualTo(10_000);
            assertThat(Thread.getAllStackTraces().keySet())
                    .filteredOn(thread -> thread.getName().equals("many-timers"))
                    .hasSize(1)
                    .allMatch(Thread::isDaemon);
            asked.forEach(promise -> promise.resolve(1));
            assertThat(Promise.all(limited).get(PATIENCE)).hasSize(10_000);
            assertThat(space.metrics().timers()).isZero();
        }
    }

    @Test
    void spaceThatIsClosed_endsWhatWasAskedOfIt_andItsThread() throws Exception {
        var space = ActorSpace.create(SpaceSettings.named("closing"));
        Promise<?> delay = space.delay(LONG);
        Promise<?> limited = new Deferred<String>(space).orTimeout(LONG);
        List<Thread> threads = Thread.getAllStackTraces().keySet().stream()
                .filter(thread -> thread.getName().equals("closing-timers"))
                .toList();
        assertThat(threads).hasSize(1);
        assertThat(space.close(PATIENCE).timers()).isEqualTo(2);
        for (var promise : List.of(delay, limited, space.delay(SOON))) {
            assertThatThrownBy(() -> promise.get(PATIENCE))
                    .isInstanceOf(CancellationException.class)
                    .hasMessageContaining("space closing was closed before");
        }
        threads.getFirst().join();
    }
}
