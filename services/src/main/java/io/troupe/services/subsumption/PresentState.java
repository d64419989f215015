package io.troupe.services.subsumption;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * The state in which the robots are, and the references of its services: what the arbitrators of both asynchronous
 * modes have in common.
 */
final class PresentState {
    private final RobotServices services;
    private final Arbitrator.StateListener listener;
    private final Map<Integer, AtomicReference<Integer>> references = new TreeMap<>();
    private final Deferred<@Nullable Void> failed = new Deferred<>();
    private State state;
    private @Nullable Integer seenBy;
    private int changes;

    PresentState(RobotServices services, State first, Arbitrator.StateListener listener) {
        this.services = services;
        this.state = first;
        this.listener = listener;
    }

    State state() {
        return state;
    }

    /** How many states there have been before this one; what is told with another number is about another state. */
    int changes() {
        return changes;
    }

    Service service(int robot) {
        return state.services().get(robot);
    }

    /** Its services are about to begin. */
    void begins() {
        listener.began(state, seenBy);
    }

    /** The reference of the service that is about to drive a robot. */
    AtomicReference<Integer> newReference(int robot) {
        var reference = new AtomicReference<>(ServiceLoop.RUN);
        references.put(robot, reference);
        return reference;
    }

    static AtomicReference<Integer> newColourFinder(Service service) {
        return new AtomicReference<>(service.findsColours() ? ServiceLoop.RUN : ServiceLoop.STOP);
    }

    /**
     * Tells all services to stop.
     *
     * @return fulfilled when they have, so that those of the next state can begin
     */
    Promise<?> change(State next, int robot) {
        state = next;
        changes++;
        seenBy = robot;
        var stops = references.values().stream().map(services::stop).toList();
        references.clear();
        return Promise.all(stops);
    }

    /** Nobody arbitrates any more: the services stop at their next reading. */
    void abandon() {
        references.values().forEach(reference -> reference.compareAndSet(ServiceLoop.RUN, ServiceLoop.STOP));
    }

    void fail(Throwable error) {
        failed.reject(error);
    }

    /** Rejected when a service fails; never fulfilled. */
    Promise<@Nullable Void> failed() {
        return failed;
    }
}
