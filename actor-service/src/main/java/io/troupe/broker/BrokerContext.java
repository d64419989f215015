package io.troupe.broker;

import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;

/** What the registrations of one broker share. Used on the broker's space. */
final class BrokerContext {
    /** What starts and failures mean for the clients and the other registrations of the broker. */
    interface Listener {
        /** Withdrawn or replaced providers that have to stop before this one is started. */
        List<ManagedProvider> predecessors(ManagedProvider registration);

        void onStarted(ManagedProvider registration);

        void onFailed(ManagedProvider registration);

        /** A withdrawn or replaced provider has stopped, or the limit of its stop is over. */
        void onGone(ManagedProvider registration);

        /** Returns whether a connection waits for this provider. */
        boolean isWanted(ManagedProvider registration);
    }

    final BrokerSettings settings;
    final Timeouts timeouts;
    final EventPublisher events;
    final Listener listener;
    private final Set<ManagedProvider> begun =
            new LinkedHashSet<>(); // those that may run, in the order of their starts
    private boolean closing;

    BrokerContext(BrokerSettings settings, Timeouts timeouts, EventPublisher events, Listener listener) {
        this.settings = settings;
        this.timeouts = timeouts;
        this.events = events;
        this.listener = listener;
    }

    void setMayRun(ManagedProvider registration, boolean mayRun) {
        begun.remove(registration);
        if (mayRun) {
            begun.add(registration);
        }
    }

    /** Providers that may run, in the order of their starts. */
    List<ManagedProvider> begun() {
        return List.copyOf(begun);
    }

    void beginClosing() {
        closing = true;
        begun.forEach(ManagedProvider::cancelTimers);
    }

    boolean isClosing() {
        return closing;
    }
}
