package io.troupe.services.component.application;

import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceRecord;
import io.troupe.services.component.application.ApplicationPlan.Replacement;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import java.util.List;

/** An event of an application, for its observer. */
public sealed interface ApplicationEvent {
    /**
     * A user has been connected with a provider, its first or another.
     *
     * @param wires the connected topics of user and provider
     */
    record Connected(Need need, ServiceRecord provider, List<Wire<?>> wires) implements ApplicationEvent {}

    /**
     * A user has lost its provider. The application ends if there is no other within
     * {@link ApplicationSettings#reconnectLimit}.
     */
    record Lost(Need need, MissingServiceException why) implements ApplicationEvent {}

    /** A value was forwarded over a wire. */
    record Forwarded(Wire<?> wire, Record value) implements ApplicationEvent {}

    record Replaced(Replacement what) implements ApplicationEvent {}

    /** A replacement has failed; the old component stays in use. */
    record NotReplaced(Replacement what, Throwable why) implements ApplicationEvent {}
}
