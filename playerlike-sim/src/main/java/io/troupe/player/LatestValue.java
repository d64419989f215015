package io.troupe.player;

import java.util.concurrent.atomic.AtomicBoolean;
import org.jspecify.annotations.Nullable;

/**
 * The newest value of some kind, with a flag that is set until the value is polled.
 *
 * <p><b>Threads.</b> Any thread. The value is written before the flag and read after it, so a caller that sees the flag
 * also sees the value.
 */
final class LatestValue<T> {
    private final AtomicBoolean isNew = new AtomicBoolean();
    private volatile @Nullable T value;

    void put(T newest) {
        value = newest;
        isNew.set(true);
    }

    @Nullable
    T get() {
        return value;
    }

    boolean isNew() {
        return isNew.get();
    }

    /** True once for each {@link #put}. */
    boolean takeNew() {
        return isNew.get() && isNew.getAndSet(false);
    }
}
