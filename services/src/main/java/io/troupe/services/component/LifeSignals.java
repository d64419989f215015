package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.services.bus.Address;
import java.util.function.Consumer;

/**
 * What the component says in one of its lives: after that it is told, and has no effect.
 *
 * @param speaker the life
 * @param output takes data, on any thread
 * @param failed hears of a failure, on the space
 */
record LifeSignals<O>(
        Life<?, O> speaker,
        ActorSpace space,
        Address owner,
        ComponentObserver observer,
        Consumer<? super O> output,
        Consumer<Throwable> failed)
        implements ComponentCommunication.Signals<O> {
    @Override
    public void data(O data) {
        if (speaker.isOver()) {
            observer.told(owner, "gave data after its end: " + data);
            return;
        }
        try {
            output.accept(data);
        } catch (ActorStoppedException closed) {
            observer.told(owner, "gave data after its space had been closed: " + data);
        }
    }

    @Override
    public void failed(Throwable why) {
        try {
            space.execute(() -> failed.accept(why));
        } catch (ActorStoppedException closed) {
            observer.told(owner, "failed after its space had been closed: " + why.getMessage());
        }
    }

    @Override
    public void tell(String what) {
        observer.told(owner, what);
    }
}
