package io.troupe.broker;

import io.troupe.actor.ActorSpace;

/** Notifies the observer; its exceptions never reach the broker. */
final class EventPublisher {
    private final BrokerObserver observer;
    private final ActorSpace space;
    private Runnable onEvent = () -> {};

    /** @param space reports the observer's exceptions */
    EventPublisher(BrokerObserver observer, ActorSpace space) {
        this.observer = observer;
        this.space = space;
    }

    /** @param listener is called after each event, on the broker's space */
    void setOnEvent(Runnable listener) {
        onEvent = listener;
    }

    void publish(BrokerEvent event) {
        onEvent.run();
        try {
            observer.on(event);
        } catch (RuntimeException | Error thrown) {
            thrown.addSuppressed(
                    new IllegalStateException("the broker's observer threw this when it was notified of " + event));
            space.execute(() -> {
                throw thrown;
            });
        }
    }
}
