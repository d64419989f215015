package io.troupe.services.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;

/**
 * A connection to a service by an actor's interface: calls reach whoever provides it at the moment.
 *
 * <p><b>Role.</b> Made by {@link ActorServices#connect}; closed by whoever made it.
 *
 * <p><b>Threads.</b> Any thread calls the actor. Answers and callbacks come to the caller's own space, as those of any
 * actor.
 *
 * <p><b>Order.</b> Calls of one sender reach one provider in the order in which they were made. At most once: a call is
 * never sent to a second provider, since the first may have done what was asked.
 *
 * <p><b>Cost.</b> A call takes two messages and a reflective call instead of one message: the connection is an actor of
 * its own, on the space of whoever made it, which keeps the calls in order, with their limits, without locks.
 *
 * <p><b>Errors.</b> A request waits, within its limit, while there is no provider. It is rejected with a
 * {@link ServiceCallException} if none comes, if its provider ends while it is under way, or does not answer within the
 * limit; an answer after that is told to the observer. One whose caller has cancelled it, or whose time limit
 * ({@link Promise#orTimeout}) has passed while nobody else listens, is cancelled: it is forgotten at once, and not
 * begun by a provider that has not begun it. A one-way call waits for a shorter time
 * ({@link ConnectionSettings#oneWayLimit}), and one that finds no provider is told to the observer; one that waits in
 * the mailbox of a provider when that stops is a dead letter of that provider's space.
 */
public final class ActorConnection<A> implements AutoCloseable {
    private final ActorSpace space;
    private final Caller caller;
    private final A actor;
    private final Promise<ServiceRecord> first;

    private ActorConnection(ActorSpace space, Caller caller, A actor, Promise<ServiceRecord> first) {
        this.space = space;
        this.caller = caller;
        this.actor = actor;
        this.first = first;
    }

    static <A> ActorConnection<A> open(
            ActorSpace space, ActorServices services, Class<A> type, Need need, ConnectionSettings settings) {
        var first = new Deferred<ServiceRecord>(null);
        Caller caller = space.spawn(
                Caller.class,
                () -> new CallerActor(services, type, need, settings, first),
                ActorSettings.named("\"" + need.by() + "\"'s connection to " + Roster.what(need)));
        return new ActorConnection<>(space, caller, Relay.of(type, need, space, caller), first);
    }

    /** Stands for the provider; use it as any proxy, from the first moment on. */
    public A actor() {
        return actor;
    }

    /**
     * Tells whether there is anybody.
     *
     * @return the first provider; rejected with a {@link MissingServiceException} if there was none when the connection
     *     was made (one that comes later is used), with an {@link IllegalArgumentException} if it cannot be called by
     *     this interface
     */
    public Promise<ServiceRecord> first() {
        return first;
    }

    /** The actor, when there is a provider; rejected as {@link #first} is. */
    public Promise<A> whenReady() {
        return first.thenApply(provider -> actor);
    }

    /** Ends the connection; calls that have no answer yet are rejected. */
    @Override
    public void close() {
        space.stop(caller);
    }
}
