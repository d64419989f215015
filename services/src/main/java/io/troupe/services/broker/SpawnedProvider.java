package io.troupe.services.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Address;
import java.util.concurrent.ConcurrentMap;
import org.jspecify.annotations.Nullable;

/** A provider for an existing actor: the code that spawned the actor also stops it. */
final class SpawnedProvider implements Provider {
    private final ActorSpace space;
    private final ActorProvider.Running life;
    private final ConcurrentMap<Address, ActorProvider.Running> directory;

    SpawnedProvider(
            Address address, ActorSpace space, Object proxy, ConcurrentMap<Address, ActorProvider.Running> directory) {
        this.space = space;
        this.life = ActorProvider.Running.of(address, space, proxy, directory);
        this.directory = directory;
    }

    @Override
    public Promise<@Nullable Void> start() {
        if (life.hasEnded()) {
            return Promise.failed(new ProviderException(
                    life.address() + " has stopped, and only who spawned it can spawn it again", null));
        }
        life.enter(directory);
        return Promise.done();
    }

    @Override
    public Promise<@Nullable Void> stop() {
        directory.remove(life.address(), life);
        return Promise.done();
    }

    @Override
    public Promise<@Nullable Void> check() {
        return ActorProvider.check(space, life);
    }

    @Override
    public Promise<@Nullable Void> whenEnded() {
        return space.whenStopped(life.proxy());
    }
}
