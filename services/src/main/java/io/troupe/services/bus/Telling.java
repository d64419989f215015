package io.troupe.services.bus;

import java.util.function.Consumer;

/** Notifies the observer of a node, and counts losses. */
final class Telling {
    private final BusObserver observer;
    private final Counters counters;

    Telling(BusObserver observer, Counters counters) {
        this.observer = observer;
        this.counters = counters;
    }

    void passed(Message message) {
        tell(it -> it.passed(message));
    }

    void undeliverable(Message message, String why) {
        counters.undeliverable.increment();
        lost(new Loss.Undeliverable(message, why));
    }

    void late(Message reply, String why) {
        counters.late.increment();
        lost(new Loss.Late(reply, why));
    }

    /** Reports a loss that its caller counts. */
    void lost(Loss loss) {
        tell(it -> it.lost(loss));
    }

    void answererFailed(Message question, Throwable error) {
        tell(it -> it.failed(question, error));
    }

    private void tell(Consumer<BusObserver> what) {
        try {
            what.accept(observer);
        } catch (RuntimeException | Error failure) { // an observer's exception must not end a delivery
            LoggingObserver.observerFailed(failure);
        }
    }
}
