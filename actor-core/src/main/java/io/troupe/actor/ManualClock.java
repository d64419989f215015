package io.troupe.actor;

import java.time.Duration;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicLong;

/**
 * A clock that is moved by a test or by a simulated world. It starts at zero.
 *
 * {@snippet :
 * ManualClock clock = new ManualClock();
 * ActorSpace space = ActorSpace.create(
 *         SpaceSettings.named("simulation").withClock(clock).withoutThread());
 * Promise<String> late =
 *         space.<String>deferred().orTimeout(Duration.ofSeconds(2)).exceptionally(error -> "too late");
 * space.runQueued();
 * clock.advance(Duration.ofSeconds(2));
 * space.runQueued(); // serves the timers that are due
 * }
 *
 * <p><b>Threads.</b> Any thread. Spaces that use it wake up when it moves.
 */
public final class ManualClock implements Clock {
    private final AtomicLong nanos = new AtomicLong();
    private final List<Runnable> listeners = new CopyOnWriteArrayList<>();

    /** Creates a clock that shows 0. */
    public ManualClock() {}

    @Override
    public long nanos() {
        return nanos.get();
    }

    /**
     * Moves the clock forward by a duration. Concurrent calls add up.
     *
     * @throws IllegalArgumentException if the duration is negative
     */
    public void advance(Duration duration) {
        if (duration.isNegative()) {
            throw new IllegalArgumentException("a clock does not go back: by " + duration);
        }
        nanos.getAndAccumulate(duration.toNanos(), Math::addExact);
        listeners.forEach(Runnable::run);
    }

    /**
     * Moves the clock to a moment.
     *
     * @throws IllegalArgumentException if that moment has passed
     */
    public void advanceTo(long newNanos) {
        long before = nanos.getAndAccumulate(newNanos, Math::max);
        if (newNanos < before) {
            throw new IllegalArgumentException(
                    "a clock does not go back: from " + before + " ns to " + newNanos + " ns");
        }
        listeners.forEach(Runnable::run);
    }

    /** Moves the clock to a moment, unless that has passed: for several threads that move the same clock. */
    public void advanceToAtLeast(long newNanos) {
        if (nanos.getAndAccumulate(newNanos, Math::max) < newNanos) {
            listeners.forEach(Runnable::run);
        }
    }

    @Override
    public Runnable onMove(Runnable wake) {
        Objects.requireNonNull(wake, "wake");
        Runnable registration = wake::run; // a new object, so that the same listener can be registered twice
        listeners.add(registration);
        return () -> listeners.remove(registration);
    }

    @Override
    public boolean runsByItself() {
        return false;
    }
}
