package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.player.PlayerException;
import java.util.HashMap;
import java.util.IdentityHashMap;
import java.util.Map;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/** The running services, at most one per robot. <b>Threads.</b> The actor space's thread. */
final class Charges implements AutoCloseable {
    private final ServiceObserver observer;
    private final ActorSpace space;
    private final RobotLinks links;
    private final Map<Integer, ServiceLoop> inCharge = new HashMap<>();
    private final Map<AtomicReference<Integer>, ServiceLoop> byReference = new IdentityHashMap<>();

    Charges(RobotServices.Settings settings, ActorSpace space) {
        this.observer = settings.observer();
        this.space = space;
        this.links = new RobotLinks(settings, space);
    }

    /**
     * Starts a service for a robot, as soon as the robot's previous service has stopped.
     *
     * @return settled when the new service has stopped
     * @throws IllegalStateException if the previous service is still set to run, or the reference belongs to another
     *     service
     */
    Promise<@Nullable Void> begin(
            int robot, Service service, AtomicReference<Integer> reference, ServiceCycle.Finder finder) {
        ServiceLoop before = inCharge.get(robot);
        if (before == null) {
            return start(robot, service, reference, finder);
        }
        if (before.isToRun()) {
            throw new IllegalStateException("robot " + (robot + 1) + " is in the charge of " + before.service()
                    + " and was to get " + service + ": set the reference of the first to 0 before");
        }
        before.wake();
        return before.ended()
                .handle((stopped, error) -> null)
                .thenCompose(free -> begin(robot, service, reference, finder));
    }

    private Promise<@Nullable Void> start(
            int robot, Service service, AtomicReference<Integer> reference, ServiceCycle.Finder finder) {
        ServiceLoop other = byReference.get(reference);
        if (other != null) {
            throw new IllegalStateException("the reference for " + service + " of robot " + (robot + 1) + " belongs to "
                    + other.service() + " of another robot: give each service a reference of its own");
        }
        RobotLink link = links.connect(robot);
        if (service.usesLaser()) {
            try {
                link.devices().useLaser(); // a service outside the table is not covered by table.usesLaser
            } catch (PlayerException refused) {
                links.serviceEnded(robot, true);
                throw refused;
            }
        }
        var loop =
                new ServiceLoop(space, robot, service, link, reference, finder, observer, links.takeReconnected(robot));
        inCharge.put(robot, loop);
        byReference.put(reference, loop);
        return loop.ended().whenComplete((stopped, error) -> {
            inCharge.remove(robot, loop);
            byReference.remove(reference, loop);
            links.serviceEnded(robot, error instanceof PlayerException);
        });
    }

    /** Wakes the service of a cleared reference. The result is that of {@link RobotServices#stop}. */
    Promise<@Nullable Void> stop(AtomicReference<Integer> reference) {
        ServiceLoop loop = byReference.get(reference);
        if (loop == null) {
            return Promise.done();
        }
        loop.wake();
        return loop.ended();
    }

    /** Closes the connections with all robots. */
    @Override
    public void close() {
        links.closeAll();
    }
}
