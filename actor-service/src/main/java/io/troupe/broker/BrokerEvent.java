package io.troupe.broker;

import org.jspecify.annotations.Nullable;

/**
 * An event at a broker. There may be further kinds in later versions: a {@code switch} needs a {@code default}.
 *
 * {@snippet :
 * BrokerObserver observer = event -> {
 *     if (event instanceof BrokerEvent.FailedOver change) {
 *         show(change.from().provider() + " > " + change.to().provider());
 *     }
 * };
 * }
 */
public interface BrokerEvent {
    record Registered(ServiceRecord provider) implements BrokerEvent {}

    /** The provider is being started on demand. */
    record Starting(ServiceRecord provider) implements BrokerEvent {}

    record Started(ServiceRecord provider) implements BrokerEvent {}

    record StartFailed(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /** The provider has not answered its health check in time. */
    record Suspect(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /** The provider was suspect, and has answered a health check. */
    record Recovered(ServiceRecord provider) implements BrokerEvent {}

    /**
     * The running provider has failed and is no longer used. {@link Provider#stop} is called, because it may still run.
     */
    record Failed(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /** A client without a provider got one. */
    record Connected(Need need, ServiceRecord to) implements BrokerEvent {}

    /** A client got another provider, because its previous one failed, was withdrawn or was replaced. */
    record FailedOver(Need need, ServiceRecord from, ServiceRecord to) implements BrokerEvent {}

    /** A client has no provider any more. */
    record Lost(Need need, MissingServiceException why) implements BrokerEvent {}

    record Replaced(ServiceRecord old, ServiceRecord by) implements BrokerEvent {}

    record Withdrawn(ServiceRecord provider) implements BrokerEvent {}

    record Stopped(ServiceRecord provider) implements BrokerEvent {}

    /** The provider's stop failed or timed out; it may still run. */
    record StopFailed(ServiceRecord provider, Throwable why) implements BrokerEvent {}

    /**
     * An answer arrived after its time limit, when the caller had already been rejected.
     *
     * @param asked the call, for example {@code "start"} or {@code "Clock.now()"}
     * @param error null if the late answer was a success
     */
    record Late(String provider, String asked, @Nullable Throwable error) implements BrokerEvent {}

    /**
     * A {@link Broker.Connection} threw an exception, or did not return in time when it was notified; {@code why} has
     * the details.
     */
    record UserFailed(Need need, Throwable why) implements BrokerEvent {}

    /** The connected actor has stopped, or its space is closed: its connection has ended. */
    record UserGone(Need need) implements BrokerEvent {}

    /** A one-way call through a connection was not delivered to any provider. */
    record CallRejected(Need need, String call, Throwable why) implements BrokerEvent {}

    /**
     * The process that had a provider of this process started is gone or silent, and the provider runs only for others
     * ({@link Sharing#withUnusedStopped}): it is stopped.
     */
    record Unused(ServiceRecord provider, String why) implements BrokerEvent {}

    /** The broker's space was closed before the broker. The provider may still run. */
    record LeftRunning(ServiceRecord provider) implements BrokerEvent {}
}
