package io.troupe.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Request;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** A provider that spawns an actor when the broker starts it. Called on the broker's space. */
final class ActorProvider<A> implements Provider {
    /** A running actor of this process. Calls pass references. */
    static final class Running extends RunningActor {
        private final Object proxy;
        private final Promise<?> ended;

        private Running(Address address, Object proxy, Promise<?> ended) {
            super(address);
            this.proxy = proxy;
            this.ended = ended;
        }

        /** @param onEnd called when the actor has stopped, before those who watch */
        static Running of(Address address, ActorSpace space, Object proxy, Consumer<Running> onEnd) {
            var life = new Running(address, proxy, space.whenStopped(proxy));
            life.ended.toCompletableFuture().whenComplete((nothing, error) -> {
                onEnd.accept(life);
                life.settleWatches();
            });
            return life;
        }

        Object proxy() {
            return proxy;
        }

        @Override
        boolean hasEnded() {
            return ended.isDone();
        }

        @Override
        boolean isOver() {
            return hasEnded();
        }

        @Override
        @Nullable
        String mismatch(Class<?> type) {
            return type.isInstance(proxy) ? null : "is a " + interfacesOf(proxy);
        }

        private static String interfacesOf(Object proxy) {
            Class<?>[] interfaces = proxy.getClass().getInterfaces();
            return interfaces.length > 0
                    ? interfaces[0].getName()
                    : proxy.getClass().getName();
        }

        @Override
        @Nullable
        Promise<?> send(Class<?> type, QueueEntry call, RemoteCaller remote, @Nullable Duration limit)
                throws NotSentException {
            try {
                if (call instanceof Message message) {
                    message.serveWith(proxy);
                    return null;
                }
                return ((Request<?>) call).sendTo(proxy);
            } catch (Throwable thrown) { // by the proxy: for example a full mailbox
                throw new NotSentException(thrown);
            }
        }

        @Override
        @Nullable
        Object result(Class<?> type, QueueEntry call, @Nullable Object answer) {
            return answer;
        }
    }

    private final Address address;
    private final ActorSpace space;
    private final Class<A> type;
    private final Supplier<? extends A> factory;
    private final ActorSettings settings;
    private final LocalActors actors;
    private @Nullable Running running;

    ActorProvider(
            Address address,
            ActorSpace space,
            Class<A> type,
            Supplier<? extends A> factory,
            ActorSettings settings,
            LocalActors actors) {
        this.address = address;
        this.space = space;
        this.type = type;
        this.factory = factory;
        this.settings = settings;
        this.actors = actors;
    }

    @Override
    public Promise<@Nullable Void> start() {
        var failure = new AtomicReference<@Nullable Throwable>();
        A proxy = space.spawn(type, () -> make(failure), settings);
        var life = actors.begin(address, space, proxy);
        running = life;
        Deferred<@Nullable Void> started = Deferred.unbound();
        // runs after the entry that starts the actor
        space.execute(() -> {
            if (life.hasEnded()) {
                Throwable why = failure.get();
                started.reject(new ProviderException(
                        address + " stopped when it was started" + (why == null ? "" : ": " + Reasons.of(why)), why));
            } else {
                try {
                    actors.enter(life, space, type);
                    started.resolve(null);
                } catch (RuntimeException taken) { // its name on the bus
                    space.stop(proxy);
                    started.reject(new ProviderException(address + " was not started: " + taken.getMessage(), taken));
                }
            }
        });
        return started;
    }

    private A make(AtomicReference<@Nullable Throwable> failure) {
        try {
            return factory.get();
        } catch (RuntimeException | Error thrown) {
            failure.set(thrown); // the space's error handler receives it as well
            throw thrown;
        }
    }

    @Override
    public Promise<@Nullable Void> stop() {
        Running life = running;
        if (life == null) {
            return Promise.done();
        }
        actors.leave(life);
        space.stop(life.proxy());
        return ended(space, life);
    }

    @Override
    public Promise<@Nullable Void> check() {
        return check(space, running);
    }

    /** Fulfilled when the actor has stopped, for whatever reason. */
    static Promise<@Nullable Void> ended(ActorSpace space, Running life) {
        Deferred<@Nullable Void> ended = space.deferred();
        space.whenStopped(life.proxy()).toCompletableFuture().thenRun(() -> ended.resolve(null));
        return ended;
    }

    /**
     * A health check: appends an entry to the space's mailbox queue. It is fulfilled after all earlier messages of the
     * space.
     */
    static Promise<@Nullable Void> check(ActorSpace space, @Nullable Running life) {
        if (life == null || life.hasEnded()) {
            return Promise.failed(new ProviderException((life == null ? "it" : life.address()) + " has stopped", null));
        }
        Deferred<@Nullable Void> back = Deferred.unbound();
        space.execute(() -> back.resolve(null));
        return back;
    }

    @Override
    public Promise<@Nullable Void> whenEnded() {
        Running life = running;
        return life == null ? Promise.done() : ended(space, life);
    }
}
