package io.troupe.services.component;

import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * The component communication unit (CCU): control signals and data signals between an interface and the component
 * itself.
 *
 * <p><b>Role.</b> Implemented once for each kind of component, in terms of that component's own protocol and data. One
 * object serves one life of the component: each invocation gets a new one.
 *
 * <p><b>Threads.</b> Called on the actor space of the interface, and must not hold it. {@link Signals} may be called
 * from any thread.
 *
 * <p><b>Errors.</b> An exception or error from {@link #invoke} or {@link #data}, a rejected promise, and
 * {@link Signals#failed} all mean that the component has failed; its interface then terminates it and says so to
 * whoever asks.
 *
 * <p><b>Source.</b> Paper, section 2.2.2.1.
 *
 * @param <I> the data that the component takes, in its own form
 * @param <O> the data that the component gives, in its own form
 */
public interface ComponentCommunication<I, O> {
    /** Control: starts the component. Fulfilled when it runs. */
    Promise<@Nullable Void> invoke(Signals<? super O> signals);

    /** Control: ends the component, whatever state it is in. Fulfilled when it has ended. */
    Promise<@Nullable Void> terminate();

    /** Control: fulfilled when the component is well, rejected with what is wrong. */
    Promise<@Nullable Void> health();

    /** Data to the component; only while it runs. */
    void data(I input);

    /** What a component says by itself. */
    interface Signals<O> {
        /** Data from the component. */
        void data(O output);

        /** It has ended by itself, or cannot go on. */
        void failed(Throwable why);

        /** Something that people should know of, and that is no failure. */
        void tell(String what);
    }
}
