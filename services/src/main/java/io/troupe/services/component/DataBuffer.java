package io.troupe.services.component;

import io.troupe.services.component.Buffering.OverflowPolicy;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The bounded buffer of a {@link DataConversion}.
 *
 * <p><b>Threads.</b> Any thread; guarded by one lock that is held briefly.
 */
final class DataBuffer {
    private final Buffering buffering;
    private final Deque<ApplicationData<?>> values = new ArrayDeque<>(); // guarded by this, as are the counters
    private long dropped;
    private long superseded;

    DataBuffer(Buffering buffering) {
        this.buffering = buffering;
    }

    /**
     * Adds a value.
     *
     * @return the value that was dropped to make room, or null
     */
    synchronized @Nullable ApplicationData<?> add(ApplicationData<?> data) {
        if (buffering.overflow() == OverflowPolicy.LATEST_OF_EACH_TOPIC
                && values.removeIf(each -> each.topic().equals(data.topic()))) {
            superseded++;
        }
        ApplicationData<?> oldest = values.size() == buffering.capacity() ? values.poll() : null;
        if (oldest != null) {
            dropped++;
        }
        values.add(data);
        return oldest;
    }

    /** Removes and returns all values, the oldest first. */
    synchronized List<ApplicationData<?>> drain() {
        List<ApplicationData<?>> drained = new ArrayList<>(values);
        values.clear();
        return drained;
    }

    synchronized long dropped() {
        return dropped;
    }

    synchronized long superseded() {
        return superseded;
    }
}
