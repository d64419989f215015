package io.troupe.actor.internal;

import io.troupe.actor.Promise;
import io.troupe.actor.Request;
import java.util.function.Function;
import java.util.function.Supplier;

/**
 * What an actor of any actor type may be instead of an implementation: it passes the calls on. A connection to a
 * service is such an actor. Called on the actor's space, in the turn of the call.
 */
public interface Forwarder {
    /**
     * Makes a forwarder. The space notes by this type, before the actor starts, that its calls are passed on.
     *
     * @param unsent makes the error of a call that arrives after the end, from its text; kept as long as the proxy
     */
    record Factory(Supplier<? extends Forwarder> forwarder, Function<String, RuntimeException> unsent)
            implements Supplier<Object> {
        @Override
        public Object get() {
            return forwarder.get();
        }
    }

    /** Passes on a one-way message. */
    void forward(Message message);

    /** Passes on a request, which has the outcome of the returned promise. */
    Promise<?> forward(Request<?> request);

    /** A request that was passed on has been cancelled, or all its listeners have reached their time limits. */
    void abandoned(Request<?> request);
}
