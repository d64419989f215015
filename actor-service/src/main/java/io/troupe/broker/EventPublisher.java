package io.troupe.broker;

import io.troupe.actor.ActorSpace;

/** Notifies the observer; its exceptions never reach the broker. */
final class EventPublisher {
    private final BrokerObserver observer;
    private final ActorSpace space;

    /** @param space reports the observer's exceptions */
    EventPublisher(BrokerObserver observer, ActorSpace space) {
        this.observer = observer;
        this.space = space;
    }

    void publish(BrokerEvent event) {
        try {
            observer.on(event);
        } catch (RuntimeException | Error thrown) {
            thrown.addSuppressed(
                    new IllegalStateException("the broker's observer threw this when it was told " + event));
            space.execute(() -> {
                throw thrown;
            });
        }
    }
}
