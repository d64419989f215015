package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * A running service: one cycle for each new reading, until its reference is cleared. A service that takes over runs its
 * first cycle on the newest reading at once, so that the robot neither stops nor keeps the old speed between two
 * services.
 *
 * <p><b>Order.</b> The reference goes from {@value #RUN} (run) to {@value #STOP} (stop) to {@value #STOPPED} (stopped).
 * When it is {@value #STOPPED}, zero speed has been sent and no cycle follows.
 *
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6: starting and stopping by atomic reference; the third value is in
 * Figure 17.
 */
final class ServiceLoop {
    static final int STOP = 0;
    static final int RUN = 1;
    static final int STOPPED = 2;
    private final int robot;
    private final Service service;
    private final RobotConnection connection;
    private final AtomicReference<Integer> reference;
    private final ServiceCycle cycle;
    private final ServiceCycle.Finder finder;
    private final ServiceObserver observer;
    private final Promise<@Nullable Void> ended;
    private boolean started;
    private boolean firstCycle = true;

    /**
     * Starts the loop.
     *
     * @param startsAtFirstReading whether the service counts as started from its first reading on, instead of at once
     */
    ServiceLoop(
            ActorSpace space,
            int robot,
            Service service,
            RobotConnection connection,
            AtomicReference<Integer> reference,
            ServiceCycle.Finder finder,
            ServiceObserver observer,
            boolean startsAtFirstReading) {
        this.robot = robot;
        this.service = service;
        this.connection = connection;
        this.reference = reference;
        this.cycle = new ServiceCycle(robot, service, connection.devices(), observer);
        this.finder = finder;
        this.observer = observer;
        if (!startsAtFirstReading) {
            notifyStarted();
        }
        this.ended = space.repeatWhile(this::shouldRun, this::nextCycle).whenComplete((done, error) -> halt(error));
    }

    Service service() {
        return service;
    }

    boolean shouldRun() {
        return reference.get() == RUN;
    }

    /** Returns a promise that is settled when the reference is {@value #STOPPED}. */
    Promise<@Nullable Void> ended() {
        return ended;
    }

    /** Makes the loop check its reference now instead of at the next reading. */
    void wake() {
        connection.wake();
    }

    private void notifyStarted() {
        started = true;
        observer.serviceStarted(robot, service);
    }

    /**
     * Runs one cycle: at once when the service takes over, otherwise at the next reading. The first cycle drives, but
     * does not look for colours. Otherwise two robots that see each other's colours would switch at every reading and
     * stand still.
     */
    private Promise<?> nextCycle() {
        boolean takesOver = firstCycle && connection.devices().hasData();
        firstCycle = false;
        if (takesOver) {
            cycle.run(ServiceCycle.Finder.NONE, this::shouldRun);
            return Promise.done();
        }
        return connection.nextData().thenAccept(this::react);
    }

    private void react(boolean dataAreReady) {
        if (dataAreReady && shouldRun() && connection.devices().hasData() && cycle.isDue()) {
            boolean takesOver = !started;
            if (takesOver) {
                notifyStarted();
            }
            cycle.run(takesOver ? ServiceCycle.Finder.NONE : finder, this::shouldRun);
        }
    }

    private void halt(@Nullable Throwable error) {
        try {
            cycle.halt();
        } catch (RuntimeException unreachable) {
            if (error == null) {
                throw unreachable;
            }
            error.addSuppressed(unreachable);
        } finally {
            reference.set(STOPPED);
            if (started) {
                observer.serviceEnded(robot, service);
            }
        }
    }
}
