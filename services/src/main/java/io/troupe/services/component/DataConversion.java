package io.troupe.services.component;

import io.troupe.services.bus.Address;
import java.util.List;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;

/**
 * The data conversion unit (DCU): turns the component's data into the application's and back, through a bounded buffer
 * for each direction.
 *
 * <p><b>Role.</b> The buffers give each side its own time: a component may deliver from a thread of its own while the
 * bus is served by the actor space, and what the bus brings while the component is being invoked waits for it.
 *
 * <p><b>Threads.</b> Any thread puts in; one at a time takes out.
 *
 * <p><b>Order.</b> First in, first out, in each direction.
 *
 * <p><b>Errors.</b> What is lost, because a buffer is full, a conversion fails or the bus refuses it, is counted and
 * told to the observer; the rest goes on.
 *
 * <p><b>Source.</b> Paper, section 2.2.2.2.
 */
public final class DataConversion<I, O> {
    /**
     * How many values did not get through, both directions together.
     *
     * @param dropped because a buffer was full
     * @param superseded because a newer one of the same topic came, where only the newest counts
     * @param refused because they could not be converted or published
     */
    public record Losses(long dropped, long superseded, long refused) {}

    private final Address owner;
    private final Conversion<I, O> conversion;
    private final ComponentObserver observer;
    private final DataBuffer toApplication;
    private final DataBuffer toComponent;
    private final AtomicLong refused = new AtomicLong();

    DataConversion(Address owner, Component<I, O> component, ComponentObserver observer) {
        this.owner = owner;
        this.conversion = component.conversion();
        this.observer = observer;
        this.toApplication = new DataBuffer(component.output());
        this.toComponent = new DataBuffer(component.input());
    }

    /** Converts what the component gives, and keeps it for {@link #drainToApplication}. */
    void fromComponent(O output) {
        List<ApplicationData<?>> converted;
        try {
            converted = List.copyOf(conversion.toApplication(output));
        } catch (RuntimeException | Error refusal) {
            refuse("convert " + output, refusal);
            return;
        }
        converted.forEach(data -> put(toApplication, data));
    }

    /** Keeps what the bus brings for {@link #drainToComponent}. */
    void fromBus(ApplicationData<?> data) {
        put(toComponent, data);
    }

    /** Publishes what waits, one by one; what cannot be published is lost alone. */
    void drainToApplication(Consumer<ApplicationData<?>> publisher) {
        for (var data : toApplication.take()) {
            try {
                publisher.accept(data);
            } catch (RuntimeException | Error refusal) {
                refuse("publish " + data, refusal);
            }
        }
    }

    /**
     * Converts what waits, one by one, and hands it to the component; what the component throws is the caller's
     * business, and ends it.
     */
    void drainToComponent(Consumer<? super I> component) {
        for (var data : toComponent.take()) {
            I input;
            try {
                input = conversion.toComponent(data);
            } catch (RuntimeException | Error refusal) {
                refuse("convert " + data, refusal);
                continue;
            }
            component.accept(input);
        }
    }

    /** Forgets what waits for the component; it was meant for a life that is over. */
    int forgetInput() {
        return toComponent.take().size();
    }

    /** How many values did not get through so far. */
    public Losses losses() {
        return new Losses(
                toApplication.dropped() + toComponent.dropped(),
                toApplication.superseded() + toComponent.superseded(),
                refused.get());
    }

    private void put(DataBuffer buffer, ApplicationData<?> data) {
        var lost = buffer.put(data);
        if (lost != null) {
            observer.dropped(owner, lost, buffer.dropped());
        }
    }

    private void refuse(String what, Throwable why) {
        refused.incrementAndGet();
        observer.problem(owner, "could not " + what, why);
    }
}
