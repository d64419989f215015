package io.troupe.broker;

import io.troupe.bus.Address;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

/** The actors of other processes that the broker has started and uses, by address. Used from any thread. */
final class RemoteActors {
    /** Receives the actors to which a call could not be delivered. */
    interface UndeliveredCalls {
        void checkNow(RemoteActor actor);
    }

    private final CallableInterfaces interfaces;
    private final Map<Address, RemoteActor> running = new ConcurrentHashMap<>();
    private volatile UndeliveredCalls onCheck = actor -> {};

    RemoteActors(CallableInterfaces interfaces) {
        this.interfaces = interfaces;
    }

    /** @param listener is called from any thread */
    void setOnCheck(UndeliveredCalls listener) {
        onCheck = listener;
    }

    /** An actor runs, and can be called. */
    RemoteActor begin(Address address, List<String> methods) {
        var actor = new RemoteActor(address, methods, interfaces);
        running.put(address, actor);
        return actor;
    }

    /** It gets no further calls. */
    void leave(RemoteActor actor) {
        running.remove(actor.address(), actor);
    }

    @Nullable
    RemoteActor running(Address address) {
        return running.get(address);
    }

    void checkNow(RemoteActor actor) {
        onCheck.checkNow(actor);
    }
}
