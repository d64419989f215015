package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Virtual threads that compute occupy all carriers; spaces do not depend on these. */
@Tag("threads")
@Timeout(120)
class BusyCarriersTest {
    private static final Duration LONG = Duration.ofSeconds(30);

    private static final int BODIES = 2_000;

    private final AtomicBoolean computing = new AtomicBoolean(true);

    private interface Task {
        void run() throws Exception;
    }

    private void whileAllCarriersAreBusy(Task task) throws Exception {
        int carriers = Integer.getInteger(
                "jdk.virtualThreadScheduler.parallelism", Runtime.getRuntime().availableProcessors());
        var begun = new CountDownLatch(carriers);
        var threads = new ArrayList<Thread>();
        for (int carrier = 0; carrier < carriers; carrier++) {
            threads.add(Thread.ofVirtual().start(() -> {
                begun.countDown();
                while (computing.get()) {
                    Thread.onSpinWait();
                }
            }));
        }
        try {
            assertThat(begun.await(30, TimeUnit.SECONDS)).isTrue();
            task.run();
        } finally {
            computing.set(false);
            for (Thread thread : threads) {
                thread.join();
            }
        }
    }

    @Test
    void sequentialBody_runsWhileAllCarriersCompute() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("bodies"))) {
            whileAllCarriersAreBusy(() -> {
                Promise<Integer> sum = space.sequential(() -> {
                    int first = space.delay(Duration.ZERO).thenApply(over -> 1).await();
                    return first + 1;
                });
                assertThat(sum.get(LONG)).isEqualTo(2);
            });
        }
    }

    @Test
    void stall_isReportedWhileAllCarriersCompute() throws Exception {
        var reported = new CountDownLatch(1);
        var seen = new Deferred<Boolean>();
        var settings = SpaceSettings.named("watched").withOnStall(Duration.ofMillis(20), stall -> reported.countDown());
        try (var space = ActorSpace.create(settings)) {
            whileAllCarriersAreBusy(() -> {
                space.execute(() -> {
                    try {
                        seen.resolve(reported.await(30, TimeUnit.SECONDS));
                    } catch (InterruptedException interrupted) {
                        seen.reject(interrupted);
                    }
                });
                assertThat(seen.get(LONG)).isTrue();
            });
        }
    }

    @Test
    void stallListener_thatWaits_doesNotKeepOtherSpacesFromBeingWatched() throws Exception {
        var otherReported = new CountDownLatch(1);
        var firstListening = new CountDownLatch(1);
        var patient = SpaceSettings.named("first").withOnStall(Duration.ofMillis(20), stall -> {
            firstListening.countDown();
            awaitQuietly(otherReported);
        });
        var other =
                SpaceSettings.named("second").withOnStall(Duration.ofMillis(20), stall -> otherReported.countDown());
        try (var first = ActorSpace.create(patient);
                var second = ActorSpace.create(other)) {
            first.execute(() -> awaitQuietly(firstListening));
            awaitQuietly(firstListening);
            second.execute(() -> awaitQuietly(otherReported));
            assertThat(otherReported.await(30, TimeUnit.SECONDS)).isTrue();
        }
    }

    private static void awaitQuietly(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
    }

    @Test
    void thousandsOfBodies_mayWaitAtATime() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("many-bodies"))) {
            var gate = new Deferred<Integer>(space);
            var bodies = new ArrayList<Promise<Integer>>();
            for (int number = 0; number < BODIES; number++) {
                bodies.add(space.sequential(gate::await));
            }
            space.execute(() -> gate.resolve(1)); // queued behind the starts of all bodies
            assertThat(Promise.all(bodies).get(LONG)).hasSize(BODIES).containsOnly(1);
        }
    }

    @Test
    void sleepingSpace_isNotSeenInATurn_andABusyOneIs() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("asleep"))) {
            var thread = new Deferred<Thread>();
            space.execute(() -> thread.resolve(Thread.currentThread()));
            Thread own = thread.get(LONG);
            while (own.getState() == Thread.State.RUNNABLE) {
                Thread.onSpinWait(); // until it sleeps
            }
            assertThat(Watchdog.isInATurn(List.of(own.getStackTrace()))).isFalse();
            var stack = new Deferred<List<StackTraceElement>>();
            space.execute(() -> stack.resolve(List.of(own.getStackTrace())));
            assertThat(Watchdog.isInATurn(stack.get(LONG))).isTrue();
            var inBody = space.sequential(() -> List.of(Thread.currentThread().getStackTrace()));
            assertThat(Watchdog.isInATurn(inBody.get(LONG))).isTrue();
        }
    }
}
