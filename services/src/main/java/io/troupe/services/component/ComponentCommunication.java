package io.troupe.services.component;

import io.troupe.actor.Promise;
import org.jspecify.annotations.Nullable;

/**
 * The component communication unit (CCU): exchanges control and data signals between an interface and its component.
 *
 * <p><b>Role.</b> Implemented once for each kind of component, in terms of that component's protocol and data. An
 * instance serves one run of the component; each invocation creates a new instance.
 *
 * <p><b>Threads.</b> Called on the actor space of the interface, which it must not block. {@link Signals} may be called
 * from any thread.
 *
 * <p><b>Errors.</b> The component has failed if {@link #invoke} or {@link #data} throws, if the promise of
 * {@link #invoke} is rejected, or if {@link Signals#failed} is called. Its interface then terminates it, and rejects
 * health checks with the error. If the promise of {@link #terminate} is rejected, the component may still be running;
 * the next start or stop terminates it again.
 *
 * <p><b>Source.</b> Paper, section 2.2.2.1.
 *
 * @param <I> type of the component's input, in the component's format
 * @param <O> type of the component's output, in the component's format
 */
public interface ComponentCommunication<I, O> {
    /** Control signal: starts the component. The promise is fulfilled when the component runs. */
    Promise<@Nullable Void> invoke(Signals<? super O> signals);

    /** Control signal: ends the component, in any state. The promise is fulfilled when the component has ended. */
    Promise<@Nullable Void> terminate();

    /**
     * Control signal: checks the component. The promise is fulfilled if the component is healthy, and rejected with the
     * problem otherwise.
     */
    Promise<@Nullable Void> health();

    /** Data signal to the component; called only while it runs. */
    void data(I input);

    /** Callbacks of the component. */
    interface Signals<O> {
        /** Data signal from the component. */
        void data(O output);

        /** The component has ended unexpectedly, or cannot continue. */
        void failed(Throwable why);

        /** An event that is not a failure, as a message for people. */
        void info(String what);
    }
}
