package io.troupe.services.component;

import io.troupe.actor.internal.BoundedQueue;
import io.troupe.bus.Address;
import java.util.List;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * The data conversion unit (DCU): converts the component's data to the application's format and back, through one
 * bounded buffer for each direction.
 *
 * <p><b>Role.</b> The buffers decouple component and bus. The component may deliver output on a separate thread while
 * the actor space serves the bus. Values from the bus are buffered while the component is being invoked.
 *
 * <p><b>Threads.</b> Any thread may add values; only one thread at a time may drain a buffer.
 *
 * <p><b>Order.</b> First in, first out, in each direction.
 *
 * <p><b>Errors.</b> A value is lost if a buffer is full, a conversion fails, or the bus rejects it. Losses are counted
 * and reported to the observer; other values are not affected.
 *
 * <p><b>Source.</b> Paper, section 2.2.2.2.
 */
public final class DataConversion<I, O> {
    /**
     * Number of lost values, both directions together.
     *
     * @param dropped values dropped because a buffer was full
     * @param replaced values replaced by a newer one of their topic, if only the latest value counts
     * @param failed values that could not be converted or published
     */
    public record Losses(long dropped, long replaced, long failed) {}

    private final Address owner;
    private final Conversion<I, O> conversion;
    private final ComponentObserver observer;
    private final DataBuffer toApplication;
    private final DataBuffer toComponent;
    private final AtomicLong failed = new AtomicLong();

    DataConversion(Address owner, Component<I, O> component, ComponentObserver observer) {
        this.owner = owner;
        this.conversion = component.conversion();
        this.observer = observer;
        this.toApplication = new DataBuffer(component.output());
        this.toComponent = new DataBuffer(component.input());
    }

    /** Converts an output of the component, and buffers it for {@link #drainToApplication}. */
    void fromComponent(O output) {
        List<ApplicationData<?>> converted;
        try {
            converted = List.copyOf(conversion.toApplication(output));
        } catch (RuntimeException | Error failure) {
            noteFailure("convert " + output, failure);
            return;
        }
        converted.forEach(data -> put(toApplication, data));
    }

    /** Buffers a value from the bus for {@link #drainToComponent}. */
    void fromBus(ApplicationData<?> data) {
        put(toComponent, data);
    }

    /**
     * Publishes the buffered output one by one. A value that cannot be published is lost; the others are still
     * published.
     */
    void drainToApplication(Consumer<ApplicationData<?>> publisher) {
        for (var data : toApplication.drain()) {
            try {
                publisher.accept(data);
            } catch (RuntimeException | Error failure) {
                noteFailure("publish " + data, failure);
            }
        }
    }

    /**
     * Converts the buffered input one by one, and passes it to the component. The drain continues after a failed
     * conversion. An exception of the component is not caught here.
     */
    void drainToComponent(Consumer<? super I> component) {
        for (var data : toComponent.drain()) {
            I input;
            try {
                input = conversion.toComponent(data);
            } catch (RuntimeException | Error failure) {
                noteFailure("convert " + data, failure);
                continue;
            }
            component.accept(input);
        }
    }

    /**
     * Drops the buffered input of an earlier run.
     *
     * @return the number of dropped values
     */
    int dropInput() {
        return toComponent.drain().size();
    }

    /** Number of values lost so far. */
    public Losses losses() {
        return new Losses(
                toApplication.dropped() + toComponent.dropped(),
                toApplication.replaced() + toComponent.replaced(),
                failed.get());
    }

    private void put(DataBuffer buffer, ApplicationData<?> data) {
        var lost = buffer.add(data);
        if (lost != null) {
            observer.dropped(owner, lost, buffer.dropped());
        }
    }

    private void noteFailure(String what, Throwable why) {
        failed.incrementAndGet();
        observer.problem(owner, "could not " + what, why);
    }

    /**
     * The bounded buffer of one direction.
     *
     * <p><b>Threads.</b> Any thread; guarded by one lock that is held briefly.
     */
    private static final class DataBuffer {
        private final Buffering buffering;
        private final BoundedQueue<ApplicationData<?>> values; // guarded by this, as are the counters
        private long dropped;
        private long replaced;

        DataBuffer(Buffering buffering) {
            this.buffering = buffering;
            this.values = BoundedQueue.droppingOldest(buffering.capacity());
        }

        /**
         * Adds a value.
         *
         * @return the value that was dropped to make room, or null
         */
        synchronized @Nullable ApplicationData<?> add(ApplicationData<?> data) {
            if (buffering.onlyLatest() && values.removeIf(each -> each.topic().equals(data.topic()))) {
                replaced++;
            }
            ApplicationData<?> oldest = values.offer(data);
            if (oldest != null) {
                dropped++;
            }
            return oldest;
        }

        /** Removes and returns all values, the oldest first. */
        synchronized List<ApplicationData<?>> drain() {
            return values.drain();
        }

        synchronized long dropped() {
            return dropped;
        }

        synchronized long replaced() {
            return replaced;
        }
    }
}
