package io.troupe.services.component;

import java.util.List;

/**
 * Converts between a component's data format and the application's.
 *
 * <p><b>Role.</b> Implemented once for each kind of component, as two pure functions.
 *
 * <p><b>Errors.</b> A value that cannot be converted is rejected by an exception with the reason. Only that value is
 * lost; the loss is counted and reported to the observer.
 *
 * @param <I> type of the component's input
 * @param <O> type of the component's output
 */
public interface Conversion<I, O> {
    /** Converts an output of the component to any number of values for the application, in order. */
    List<ApplicationData<?>> toApplication(O output);

    /** Converts a value from the application to an input of the component. */
    I toComponent(ApplicationData<?> input);
}
