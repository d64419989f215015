package io.troupe.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

/**
 * The running actors of one process that are services, by address; with a bus, also the ports at which other processes
 * call them. Used from any thread.
 */
final class LocalActors {
    private final @Nullable Bus bus;
    private final CallableInterfaces interfaces;
    private final Map<Address, ActorProvider.Running> running = new ConcurrentHashMap<>();
    private final Map<ActorProvider.Running, CallReceiver> receivers = new ConcurrentHashMap<>();
    private final Map<Address, List<String>> methods = new ConcurrentHashMap<>(); // of all actors that were published

    LocalActors(@Nullable Bus bus, CallableInterfaces interfaces) {
        this.bus = bus;
        this.interfaces = interfaces;
    }

    /**
     * An actor is published.
     *
     * @throws IllegalArgumentException if there is a bus, and other processes cannot call it by that interface
     */
    void publish(Address address, Class<?> type) {
        if (bus != null) {
            methods.put(address, interfaces.of(type).names());
        }
    }

    /** The names of the methods of a published actor; empty if there is none at that address. */
    List<String> methods(Address address) {
        return methods.getOrDefault(address, List.of());
    }

    /** The interface of a proxy of an actor. */
    static Class<?> interfaceOf(Object proxy) {
        return Arrays.stream(proxy.getClass().getInterfaces())
                .filter(each -> !each.getName().startsWith("io.troupe.actor.internal."))
                .findFirst()
                .orElse(proxy.getClass());
    }

    /** An actor has been spawned. It can be called from {@link #enter} on. */
    ActorProvider.Running begin(Address address, ActorSpace space, Object proxy) {
        return ActorProvider.Running.of(address, space, proxy, this::ended);
    }

    private void ended(ActorProvider.Running actor) {
        running.remove(actor.address(), actor);
        CallReceiver receiver = receivers.remove(actor);
        if (receiver != null) {
            receiver.close();
        }
    }

    /** Like {@link #enter}, from any space. */
    Promise<@Nullable Void> begun(ActorProvider.Running actor, ActorSpace space, Class<?> type) {
        if (bus == null) {
            enter(actor, space, type);
            return Promise.done();
        }
        Deferred<@Nullable Void> entered = Deferred.unbound();
        space.execute(() -> {
            try {
                enter(actor, space, type);
                entered.resolve(null);
            } catch (RuntimeException taken) { // its name on the bus
                entered.reject(
                        new ProviderException(actor.address() + " was not started: " + taken.getMessage(), taken));
            }
        });
        return entered;
    }

    /**
     * An actor can be called, unless it has ended. Called on its space.
     *
     * @throws IllegalArgumentException if another port on the bus has its name
     */
    void enter(ActorProvider.Running actor, ActorSpace space, Class<?> type) {
        if (bus != null) {
            CallReceiver known = receivers.get(actor);
            if (known == null) {
                receivers.put(actor, CallReceiver.open(bus, space, actor, interfaces.of(type), interfaces.values));
            } else {
                known.setWithdrawn(false);
            }
        }
        running.put(actor.address(), actor);
        if (actor.hasEnded()) {
            ended(actor);
        }
    }

    /** An actor is being stopped: it gets no further calls of this process. */
    void leave(ActorProvider.Running actor) {
        running.remove(actor.address(), actor);
    }

    /** An actor gets no further calls, and goes on. */
    void withdraw(ActorProvider.Running actor) {
        leave(actor);
        CallReceiver receiver = receivers.get(actor);
        if (receiver != null) {
            receiver.setWithdrawn(true);
        }
    }

    ActorProvider.@Nullable Running running(Address address) {
        return running.get(address);
    }
}
