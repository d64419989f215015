package io.troupe.services.bus;

import java.util.function.Consumer;

/** Notifies the observer of a node, and counts losses. */
final class ObserverNotifier {
    private final BusObserver observer;
    private final Counters counters;

    ObserverNotifier(BusObserver observer, Counters counters) {
        this.observer = observer;
        this.counters = counters;
    }

    void passed(BusMessage message) {
        notifyObserver(each -> each.passed(message));
    }

    void undeliverable(BusMessage message, String why) {
        counters.undeliverable.increment();
        lost(new Loss.Undeliverable(message, why));
    }

    void late(BusMessage reply, String why) {
        counters.late.increment();
        lost(new Loss.Late(reply, why));
    }

    /** Reports a loss that its caller counts. */
    void lost(Loss loss) {
        notifyObserver(each -> each.lost(loss));
    }

    void handlerFailed(BusMessage request, Throwable error) {
        notifyObserver(each -> each.failed(request, error));
    }

    private void notifyObserver(Consumer<BusObserver> event) {
        try {
            event.accept(observer);
        } catch (RuntimeException | Error failure) { // an observer's exception must not end a delivery
            LoggingObserver.observerFailed(failure);
        }
    }
}
