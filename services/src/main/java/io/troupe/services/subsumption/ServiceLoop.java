package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.services.behaviour.Velocity;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * A service while it is in charge of a robot: one cycle for each new reading, as long as its reference says so. It takes over with a cycle on the
 * reading at hand, so that no robot stands still, or rolls on, between two services.
 *
 * <p><b>Order.</b> The reference goes from {@value #RUN} (run) over {@value #STOP} (stop) to {@value #STOPPED} (stopped): when it is {@value #STOPPED}, zero
 * speed has been sent and no cycle follows.
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6: starting and stopping by atomic reference; the third value is in Figure 17.
 */
final class ServiceLoop {
    static final int STOP = 0;
    static final int RUN = 1;
    static final int STOPPED = 2;
    /** A cycle takes 100 ms; data that come more often are passed over. Half a millisecond forgives rounding. */
    private static final double CYCLE_SECONDS = 0.1 - 0.0005;

    /** One cycle of a service. */
    interface Cycle {
        /**
         * Computes what to do.
         *
         * @param first true for the cycle with which the service takes over, on a reading that the service before has seen too
         */
        Velocity run(RobotLink link, boolean first);
    }

    private final int robot;
    private final Service service;
    private final RobotLink link;
    private final AtomicReference<Integer> reference;
    private final Cycle cycle;
    private final ServiceObserver observer;
    private final Promise<@Nullable Void> ended;
    private double lastCycleSeconds = Double.NEGATIVE_INFINITY;
    private boolean tookOver;

    ServiceLoop(
            ActorSpace space,
            int robot,
            Service service,
            RobotLink link,
            AtomicReference<Integer> reference,
            Cycle cycle,
            ServiceObserver observer) {
        this.robot = robot;
        this.service = service;
        this.link = link;
        this.reference = reference;
        this.cycle = cycle;
        this.observer = observer;
        observer.began(robot, service);
        this.ended = space.repeatWhile(this::isToRun, this::round).whenComplete((done, error) -> halt(error));
    }

    AtomicReference<Integer> reference() {
        return reference;
    }

    Service service() {
        return service;
    }

    boolean isToRun() {
        return reference.get() == RUN;
    }

    /** Settled when the reference is at {@value #STOPPED}. */
    Promise<@Nullable Void> ended() {
        return ended;
    }

    /** Makes it look at its reference now instead of at the next reading. */
    void wake() {
        link.wake();
    }

    private Promise<?> round() {
        boolean takesOver = !tookOver && link.hasData();
        tookOver = true;
        if (takesOver) {
            cycle(true);
            return Promise.done();
        }
        return link.nextData().thenAccept(this::react);
    }

    private void react(boolean dataAreReady) {
        if (dataAreReady && isToRun() && link.timeSeconds() - lastCycleSeconds >= CYCLE_SECONDS) {
            cycle(false);
        }
    }

    private void cycle(boolean first) {
        lastCycleSeconds = link.timeSeconds();
        Velocity velocity = cycle.run(link, first);
        if (isToRun()) {
            link.drive(velocity);
        }
        observer.cycled(robot, service);
    }

    private void halt(@Nullable Throwable error) {
        try {
            link.drive(Velocity.STOP);
        } catch (RuntimeException unreachable) {
            if (error == null) {
                throw unreachable;
            }
            error.addSuppressed(unreachable);
        } finally {
            reference.set(STOPPED);
            observer.ended(robot, service);
        }
    }
}
