package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.services.bus.Address;
import java.util.function.Consumer;

/**
 * Receives the signals of the component during one run. Signals after the end of the run are reported to the observer
 * and otherwise ignored.
 *
 * @param speaker the run
 * @param output accepts data, on any thread
 * @param failed called with the error of a failure, on the space
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
