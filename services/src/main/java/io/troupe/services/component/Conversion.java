package io.troupe.services.component;

import java.util.List;

/**
 * The rules by which a component's own data become the application's, and the other way.
 *
 * <p><b>Role.</b> Written once for each kind of component, as two pure functions.
 *
 * <p><b>Errors.</b> What cannot be converted is refused by an exception that says why; that value is lost and told, and
 * nothing else.
 *
 * @param <I> the data that the component takes
 * @param <O> the data that the component gives
 */
public interface Conversion<I, O> {
    /** What a piece of the component's data is to the application: any number of values, in order. */
    List<ApplicationData<?>> toApplication(O output);

    /** What a value of the application is to the component. */
    I toComponent(ApplicationData<?> input);
}
