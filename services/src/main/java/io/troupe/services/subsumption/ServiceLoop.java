package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.services.behaviour.Behaviour;
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

    /** What a robot's colour finder does with what it sees in a cycle. */
    interface Finder {
        /** Looks; it may clear the service's reference, and the behaviour has no say any more. */
        void look(RobotLink link, double secondsInCharge);
    }

    private final int robot;
    private final Service service;
    private final RobotLink link;
    private final AtomicReference<Integer> reference;
    private final Behaviour behaviour;
    private final Finder finder;
    private final ServiceObserver observer;
    private final Promise<@Nullable Void> ended;
    private double lastCycleSeconds = Double.NEGATIVE_INFINITY;
    private double beganSeconds = Double.NaN;
    private boolean firstRound = true;

    ServiceLoop(
            ActorSpace space,
            int robot,
            Service service,
            RobotLink link,
            AtomicReference<Integer> reference,
            Finder finder,
            ServiceObserver observer) {
        this.robot = robot;
        this.service = service;
        this.link = link;
        this.reference = reference;
        this.behaviour = service.behaviour().get();
        this.finder = finder;
        this.observer = observer;
        observer.began(robot, service);
        this.ended = space.repeatWhile(this::isToRun, this::round).whenComplete((done, error) -> halt(error));
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
        boolean takesOver = firstRound && link.hasData();
        firstRound = false;
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

    /**
     * One cycle.
     *
     * @param takesOver true if the service before has seen this reading too: it does not look for colours then, because two robots that each see the
     *     other's colour would else switch for ever, and never move
     */
    private void cycle(boolean takesOver) {
        observer.cycleBegins(robot, service);
        lastCycleSeconds = link.timeSeconds();
        if (Double.isNaN(beganSeconds)) {
            beganSeconds = lastCycleSeconds;
        }
        if (!takesOver) {
            finder.look(link, lastCycleSeconds - beganSeconds);
        }
        if (isToRun()) {
            link.drive(behaviour.step(link.senses()).orElse(Velocity.STOP));
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
