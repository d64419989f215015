package io.troupe.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.internal.Forwarder;
import java.util.Objects;
import java.util.function.Supplier;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * A connection to a service through an actor interface: each call goes to the current provider of the service.
 *
 * {@snippet :
 * var compass = services.connect(Compass.class, Need.ofService("captain", "compass"));
 * compass.actor().heading().then(degrees -> show(degrees));
 *
 * compass.close();
 * }
 *
 * <p><b>Role.</b> Created by {@link ActorServices#connect}; closed by the code that created it.
 *
 * <p><b>Threads.</b> Any thread may call the actor. Answers and callbacks arrive on the caller's space, as for any
 * actor.
 *
 * <p><b>Order.</b> Calls of one sender reach one provider in the order in which they were made. At most once: a call is
 * never sent to a second provider, because the first may already have executed it.
 *
 * <p><b>Cost.</b> A call takes two messages instead of one: the connection is an actor of the same type, on the space
 * of the code that created it, and passes the call on. This keeps calls and their time limits in order without locks.
 *
 * <p><b>Errors.</b> While there is no provider, a request is queued until its limit. It is rejected with a
 * {@link ServiceCallException} if no provider is found, if its provider ends before the answer, or if the provider does
 * not answer within the limit; an answer after that is reported to the observer. A request is cancelled if its caller
 * cancels it, or if its time limit ({@link Promise#orTimeout}) passes and it has no other listener: it is removed at
 * once, and a provider that has not begun it does not execute it. A one-way call is queued for a shorter time
 * ({@link ConnectionSettings#oneWayLimit}); if no provider is found, this is reported to the observer. A one-way call
 * that is still in the mailbox of a provider when that stops becomes a dead letter of the provider's space.
 */
public final class ActorConnection<A> implements AutoCloseable {
    private final ActorSpace space;
    private final A actor;
    private final Promise<ServiceRecord> first;

    private ActorConnection(ActorSpace space, A actor, Promise<ServiceRecord> first) {
        this.space = space;
        this.actor = actor;
        this.first = first;
    }

    static <A> ActorConnection<A> open(
            ActorSpace space, ActorServices services, Class<A> type, Need need, ConnectionSettings settings) {
        Deferred<ServiceRecord> first = Deferred.unbound();
        var link = new Forwarder.Factory(
                () -> new ServiceLink(services, type, need, settings, first),
                unsent -> new ServiceCallException(unsent, false, null));
        A actor = space.spawn(type, asActor(link), ActorSettings.named(name(need)));
        return new ActorConnection<>(space, actor, first);
    }

    @SuppressWarnings("unchecked") // the space passes calls to a forwarder as messages, not by the methods of A
    private static <A> Supplier<A> asActor(Forwarder.Factory link) {
        return (Supplier<A>) (Supplier<?>) link;
    }

    /** Of the actor that passes the calls on, for logs and graphs: "wallFollower for arbitrator". */
    private static String name(Need need) {
        String what = Stream.of(need.service(), need.capability())
                .filter(Objects::nonNull)
                .collect(Collectors.joining(" with "));
        return what + " for " + need.by();
    }

    /** The proxy for the provider. Can be used like any actor proxy, even before a provider has been found. */
    public A actor() {
        return actor;
    }

    /**
     * The first provider of this connection.
     *
     * @return fulfilled with the first provider; rejected with a {@link MissingServiceException} if there was none when
     *     the connection was created (a later one is still used), or with an {@link IllegalArgumentException} if it
     *     does not implement this interface
     */
    public Promise<ServiceRecord> first() {
        return first;
    }

    /** Fulfilled with the actor once there is a provider; rejected like {@link #first}. */
    public Promise<A> whenReady() {
        return first.thenApply(provider -> actor);
    }

    /** Closes the connection; calls without an answer are rejected. */
    @Override
    public void close() {
        space.stop(actor);
    }
}
