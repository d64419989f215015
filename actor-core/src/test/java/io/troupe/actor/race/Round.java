package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Clock;
import io.troupe.actor.Leftovers;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.SplittableRandom;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.locks.LockSupport;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The spaces and threads of one round, and what was reported. On the thread of the test, except for its threads and
 * handlers.
 */
final class Round implements AutoCloseable {
    static final Duration LONG = Duration.ofSeconds(60);
    private static final int HELPERS = 200; // more than the bodies that wait at the same time in any round

    final SplittableRandom random;
    final Queue<Throwable> errors = new ConcurrentLinkedQueue<>();
    final Queue<String> wrong = new ConcurrentLinkedQueue<>();
    private final String prefix;
    private final int helpersBefore = alive("troupe-helper").size(); // idle ones of other tests end only after a while
    private final List<ActorSpace> spaces = new ArrayList<>();
    private final Map<ActorSpace, Leftovers> leftovers = new LinkedHashMap<>();
    private boolean ended;

    Round(long seed) {
        random = new SplittableRandom(seed);
        prefix = "soak" + seed + "-";
    }

    /** The body of one of several threads, with a separate random generator. */
    interface Body {
        void run(int number, SplittableRandom random) throws Exception;
    }

    ActorSpace space(String name) {
        return space(name, mark -> {});
    }

    /** A space whose dead letters are counted at their marks. */
    ActorSpace space(String name, Consumer<String> onDeadLetter) {
        return open(SpaceSettings.named(prefix + name), onDeadLetter);
    }

    /** A space whose actors have a quota. */
    ActorSpace spaceWithQuota(String name, int calls) {
        return open(SpaceSettings.named(prefix + name).withActorQuota(calls), mark -> {});
    }

    private ActorSpace open(SpaceSettings settings, Consumer<String> onDeadLetter) {
        var space = ActorSpace.create(settings.withoutStallLimit()
                .withOnError((where, error) -> errors.add(error))
                .withOnDeadLetter(letter -> onDeadLetter.accept(letter.message() + letter.arguments())));
        spaces.add(space);
        return space;
    }

    /** Runs a body on several threads, which start at the same time, and waits for their end. */
    void run(int count, Body body) throws InterruptedException {
        var together = new CyclicBarrier(count);
        var threads = new ArrayList<Thread>();
        for (int i = 0; i < count; i++) {
            int number = i;
            var own = random.split();
            threads.add(Thread.ofPlatform().daemon().name("caller" + i).start(() -> {
                try {
                    together.await();
                    body.run(number, own);
                } catch (Throwable thrown) {
                    wrong.add("thread " + number + " threw " + thrown + " at " + List.of(thrown.getStackTrace()));
                }
            }));
        }
        for (var thread : threads) {
            assertThat(thread.join(LONG))
                    .as(() -> "thread %s ends: %s".formatted(thread.getName(), List.of(thread.getStackTrace())))
                    .isTrue();
        }
        assertThat(wrong).isEmpty();
    }

    /** Waits until the spaces have run what was queued before. */
    static void drain(List<ActorSpace> spaces) throws Exception {
        for (var space : spaces) {
            assertThat(get(space.sequential(() -> true))).isTrue();
        }
    }

    /** A random pause or none, so that threads meet at different points. */
    static void pause(SplittableRandom random) {
        switch (random.nextInt(4)) {
            case 0 -> Thread.yield();
            case 1 -> LockSupport.parkNanos(random.nextInt(200_000));
            case 2 -> IntStream.range(0, random.nextInt(500)).forEach(i -> Thread.onSpinWait());
            default -> {}
        }
    }

    static <T extends @Nullable Object> T get(Promise<T> promise) throws Exception {
        return promise.get(LONG);
    }

    /** Waits until it is settled. */
    static <P extends Promise<?>> P settled(P promise) throws InterruptedException {
        try {
            promise.get(LONG);
        } catch (InterruptedException interrupted) {
            throw interrupted;
        } catch (Throwable rejected) {
            // some are rejected
        }
        if (!promise.isDone()) {
            throw new AssertionError(promise + " is not settled");
        }
        return promise;
    }

    /** Waits for a condition; fails after a time that is long enough to conclude that it will never hold. */
    static void until(String what, BooleanSupplier condition) {
        long endNanos = Clock.system().nanos() + LONG.toNanos();
        while (!condition.getAsBoolean()) {
            if (endNanos - Clock.system().nanos() < 0) {
                throw new AssertionError("not within " + LONG + ": " + what);
            }
            LockSupport.parkNanos(500_000);
        }
    }

    /** Closes all open spaces and waits for their threads; afterwards nothing runs any more. */
    void end() throws InterruptedException {
        ended = true;
        for (var space : spaces) {
            leftovers.put(space, space.close(LONG));
        }
        for (var thread : alive(prefix)) {
            until(
                    thread + " has ended or does something else",
                    () -> !thread.isAlive() || !thread.getName().startsWith(prefix));
        }
        leftovers.forEach(Round::check);
        assertThat(alive(prefix)).isEmpty();
        assertThat(alive("troupe-helper")).as("helper threads").hasSizeLessThan(helpersBefore + HELPERS);
        assertThat(wrong).isEmpty();
    }

    Leftovers leftovers(ActorSpace space) {
        return leftovers.get(space);
    }

    private static void check(ActorSpace space, Leftovers left) {
        int calls = left.messages() + left.requests() + left.openRequests();
        assertThat(space.whenClosed().isDone()).isTrue();
        assertThat(space.metrics().actors()).as("actors of " + space).isZero();
        assertThat(space.metrics().timers()).as("timers of " + space).isZero();
        assertThatThrownBy(() -> space.spawn(Runnable.class, () -> () -> {})).isInstanceOf(ActorStoppedException.class);
        assertThat(space.close(LONG)).isEqualTo(left);
        assertThat(left.examples()).as(left.toString()).hasSize(Math.min(20, calls));
    }

    private static List<Thread> alive(String prefix) {
        return Thread.getAllStackTraces().keySet().stream()
                .filter(thread -> thread.getName().startsWith(prefix))
                .toList();
    }

    /** Closes what a failed scenario has left open. */
    @Override
    public void close() {
        if (!ended) {
            for (var space : spaces) {
                space.close();
            }
        }
    }
}
