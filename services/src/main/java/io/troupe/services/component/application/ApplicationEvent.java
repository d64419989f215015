package io.troupe.services.component.application;

import io.troupe.services.broker.MissingServiceException;
import io.troupe.services.broker.Need;
import io.troupe.services.broker.ServiceRecord;
import io.troupe.services.component.application.ApplicationPlan.Replacement;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import java.util.List;

/** Something that happened in an application. */
public sealed interface ApplicationEvent {
    /**
     * A user has got a provider, the first or another.
     *
     * @param wires what is connected between the two
     */
    record Connected(Need need, ServiceRecord provider, List<Wire<?>> wires) implements ApplicationEvent {}

    /** A user has lost its provider; if it gets none within the application's patience, the application ends. */
    record Lost(Need need, MissingServiceException why) implements ApplicationEvent {}

    /** A value went over a wire. */
    record Carried(Wire<?> wire, Record value) implements ApplicationEvent {}

    record Replaced(Replacement what) implements ApplicationEvent {}

    /** The old one stays in use. */
    record NotReplaced(Replacement what, Throwable why) implements ApplicationEvent {}
}
