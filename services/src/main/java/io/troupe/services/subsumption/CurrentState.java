package io.troupe.services.subsumption;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/** The current state and the references of its running services. Shared code of both arbitrators. */
final class CurrentState {
    private final RobotServices services;
    private final Arbitrator.StateListener listener;
    private final Map<Integer, AtomicReference<Integer>> references = new TreeMap<>();
    private final Deferred<@Nullable Void> failure = new Deferred<>();
    private State state;
    private @Nullable Integer seenBy;
    private int changes;

    CurrentState(RobotServices services, State first, Arbitrator.StateListener listener) {
        this.services = services;
        this.state = first;
        this.listener = listener;
    }

    State state() {
        return state;
    }

    /** The number of state changes so far. A message that was sent under another number belongs to an earlier state. */
    int changes() {
        return changes;
    }

    Service service(int robot) {
        return state.services().get(robot);
    }

    /** Notifies the listener that the current state starts. */
    void notifyStarted() {
        listener.stateStarted(state, seenBy);
    }

    /** Creates the reference of the service that is about to drive a robot. */
    AtomicReference<Integer> newRunReference(int robot) {
        var reference = new AtomicReference<>(ServiceLoop.RUN);
        references.put(robot, reference);
        return reference;
    }

    static AtomicReference<Integer> newFinderReference(Service service) {
        return new AtomicReference<>(service.findsColours() ? ServiceLoop.RUN : ServiceLoop.STOP);
    }

    /**
     * Changes the state and stops all services.
     *
     * @return fulfilled when all have stopped, so that those of the next state can start
     */
    Promise<?> changeTo(State next, int robot) {
        state = next;
        changes++;
        seenBy = robot;
        var stops = references.values().stream().map(services::stop).toList();
        references.clear();
        return Promise.all(stops);
    }

    /**
     * Clears all references, so that the services stop at their next reading. Called when the arbitrator is stopped.
     */
    void clearReferences() {
        references.values().forEach(reference -> reference.compareAndSet(ServiceLoop.RUN, ServiceLoop.STOP));
    }

    void fail(Throwable error) {
        failure.reject(error);
    }

    /** Returns a promise that is rejected when a service fails, and never fulfilled. */
    Promise<@Nullable Void> failure() {
        return failure;
    }
}
