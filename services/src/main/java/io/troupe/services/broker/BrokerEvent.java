package io.troupe.services.broker;

import org.jspecify.annotations.Nullable;

/** Something that happened at a broker. */
public sealed interface BrokerEvent {
    record Registered(ServiceRecord provider) implements BrokerEvent {}

    /** It is being started, because somebody needs it. */
    record Starting(ServiceRecord provider) implements BrokerEvent {}

    record Started(ServiceRecord provider) implements BrokerEvent {}

    record StartFailed(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /** It has not answered the question for its health in time. */
    record Suspect(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /** It had been suspect, and has answered. */
    record Recovered(ServiceRecord provider) implements BrokerEvent {}

    /** It ran, and is given up; its {@link Provider#stop} is called, in case it lives. */
    record Failed(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /** A user has got a provider, when it had none. */
    record Connected(Need need, ServiceRecord to) implements BrokerEvent {}

    /** A user has got another provider in place of the one before: it failed, was withdrawn or replaced. */
    record FailedOver(Need need, ServiceRecord from, ServiceRecord to) implements BrokerEvent {}

    /** A user has no provider any more. */
    record Lost(Need need, MissingServiceException why) implements BrokerEvent {}

    record Replaced(ServiceRecord old, ServiceRecord by) implements BrokerEvent {}

    record Withdrawn(ServiceRecord provider) implements BrokerEvent {}

    record Stopped(ServiceRecord provider) implements BrokerEvent {}

    /** It was told to stop, and failed to, or has not said so in time; it may go on. */
    record StopFailed(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /**
     * An answer came after its limit, when the asker had been told that there is none.
     *
     * @param asked what was asked, for example {@code "start"} or {@code "Clock.now()"}
     * @param error null if it was a good answer
     */
    record Late(String provider, String asked, @Nullable Throwable error) implements BrokerEvent {}

    /** A {@link Broker.Connection} threw, or did not hear in time what it was told; {@code why} says which. */
    record UserFailed(Need need, Throwable why) implements BrokerEvent {}

    /** The actor that had connected has stopped, or its space is closed: its connection has ended. */
    record UserGone(Need need) implements BrokerEvent {}

    /** A one-way call through a connection has reached nobody. */
    record Undelivered(Need need, String call, Throwable why) implements BrokerEvent {}

    /** The broker's space was closed before the broker was; what it says may go on. */
    record Abandoned(ServiceRecord provider) implements BrokerEvent {}
}
