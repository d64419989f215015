package io.troupe.player;

import java.util.concurrent.atomic.AtomicBoolean;
import org.jspecify.annotations.Nullable;

/**
 * The newest of something, and whether it has been looked for since it came.
 *
 * <p><b>Threads.</b> Any thread; whoever is told that it is new sees it, because the value is written before the flag
 * and read after it.
 */
final class Latest<T> {
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
