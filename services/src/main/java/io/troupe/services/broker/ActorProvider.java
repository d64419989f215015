package io.troupe.services.broker;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Address;
import java.util.concurrent.ConcurrentMap;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** An actor that is spawned when it is started. Called on the broker's space. */
final class ActorProvider<A> implements Provider {
    /** One life of an actor that provides a service, for whoever calls it. */
    record Running(Address address, Object proxy, Promise<@Nullable Void> ended) {}

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
        var life = new Running(address, proxy, space.whenStopped(proxy));
        running = life;
        var started = new Deferred<@Nullable Void>(null);
        space.execute(
                () -> { // behind the entry that starts it
                    if (life.ended().isDone()) {
                        Throwable why = failure.get();
                        started.reject(new ProviderException(
                                address + " stopped when it was started" + (why == null ? "" : ": " + Reasons.of(why)),
                                why));
                    } else {
                        directory.put(address, life);
                        started.resolve(null);
                    }
                });
        return started;
    }

    private A make(AtomicReference<@Nullable Throwable> failure) {
        try {
            return factory.get();
        } catch (RuntimeException | Error thrown) {
            failure.set(thrown); // and the space's error handler hears of it
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

    /** An entry of the space's mailbox queue: it comes back when all that the space has been sent before is done. */
    static Promise<@Nullable Void> check(ActorSpace space, @Nullable Running life) {
        if (life == null || life.ended().isDone()) {
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
