package io.troupe.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.Address;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentMap;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** A provider that spawns an actor when the broker starts it. Called on the broker's space. */
final class ActorProvider<A> implements Provider {
    /** One running instance of an actor that provides a service. Used from any thread. */
    static final class Running {
        private final Address address;
        private final Object proxy;
        private final Promise<@Nullable Void> ended;
        private final Set<Deferred<@Nullable Void>> watches = ConcurrentHashMap.newKeySet();

        private Running(Address address, Object proxy, Promise<@Nullable Void> ended) {
            this.address = address;
            this.proxy = proxy;
            this.ended = ended;
        }

        /** Creates an instance that is removed from the directory when its actor stops. */
        static Running of(Address address, ActorSpace space, Object proxy, ConcurrentMap<Address, Running> directory) {
            var life = new Running(address, proxy, space.whenStopped(proxy));
            life.ended.toCompletableFuture().whenComplete((nothing, error) -> {
                directory.remove(address, life);
                life.watches.forEach(watch -> watch.resolve(null));
                life.watches.clear();
            });
            return life;
        }

        Address address() {
            return address;
        }

        Object proxy() {
            return proxy;
        }

        boolean hasEnded() {
            return ended.isDone();
        }

        /** Adds this instance to the directory, unless it has ended. */
        void enter(ConcurrentMap<Address, Running> directory) {
            directory.put(address, this);
            if (hasEnded()) {
                directory.remove(address, this);
            }
        }

        /**
         * Watches for the end of this instance.
         *
         * @return fulfilled when the instance ends. Pass it to {@link #unwatch} when it is no longer needed, because
         *     connections are opened and closed while a provider runs
         */
        Deferred<@Nullable Void> watch() {
            var watch = new Deferred<@Nullable Void>();
            watches.add(watch);
            if (hasEnded()) {
                watch.resolve(null);
            }
            return watch;
        }

        void unwatch(Deferred<@Nullable Void> watch) {
            watches.remove(watch);
        }
    }

    private final Address address;
    private final ActorSpace space;
    private final Class<A> type;
    private final Supplier<? extends A> factory;
    private final ActorSettings settings;
    private final ConcurrentMap<Address, Running> directory;
    private @Nullable Running running;

    ActorProvider(
            Address address,
            ActorSpace space,
            Class<A> type,
            Supplier<? extends A> factory,
            ActorSettings settings,
            ConcurrentMap<Address, Running> directory) {
        this.address = address;
        this.space = space;
        this.type = type;
        this.factory = factory;
        this.settings = settings;
        this.directory = directory;
    }

    @Override
    public Promise<@Nullable Void> start() {
        var failure = new AtomicReference<@Nullable Throwable>();
        A proxy = space.spawn(type, () -> make(failure), settings);
        var life = Running.of(address, space, proxy, directory);
        running = life;
        var started = new Deferred<@Nullable Void>(null);
        // runs after the entry that starts the actor
        space.execute(() -> {
            if (life.hasEnded()) {
                Throwable why = failure.get();
                started.reject(new ProviderException(
                        address + " stopped when it was started" + (why == null ? "" : ": " + Reasons.of(why)), why));
            } else {
                life.enter(directory);
                started.resolve(null);
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
        directory.remove(address, life);
        space.stop(life.proxy());
        return space.whenStopped(life.proxy());
    }

    @Override
    public Promise<@Nullable Void> check() {
        return check(space, running);
    }

    /**
     * A health check: appends an entry to the space's mailbox queue. It is fulfilled after all earlier messages of the
     * space.
     */
    static Promise<@Nullable Void> check(ActorSpace space, @Nullable Running life) {
        if (life == null || life.hasEnded()) {
            return Promise.failed(new ProviderException((life == null ? "it" : life.address()) + " has stopped", null));
        }
        var back = new Deferred<@Nullable Void>(null);
        space.execute(() -> back.resolve(null));
        return back;
    }

    @Override
    public Promise<@Nullable Void> whenEnded() {
        Running life = running;
        return life == null ? Promise.done() : space.whenStopped(life.proxy());
    }
}
