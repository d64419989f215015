package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.player.PlayerException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/** The running services, at most one per robot. <b>Threads.</b> The actor space's thread. */
final class RunningServices implements AutoCloseable {
    private final ServiceObserver observer;
    private final ActorSpace space;
    private final RobotConnections connections;
    private final Map<Integer, ServiceLoop> byRobot = new HashMap<>();
    private final Map<AtomicReference<Integer>, ServiceLoop> byReference = new IdentityHashMap<>();

    RunningServices(RobotServices.Settings settings, ActorSpace space) {
        this.observer = settings.observer();
        this.space = space;
        this.connections = new RobotConnections(settings, space);
    }

    /**
     * Starts a service for a robot, as soon as the robot's previous service has stopped.
     *
     * @return settled when the new service has stopped
     * @throws IllegalStateException if the previous service is still set to run, or the reference belongs to another
     *     service
     */
    Promise<@Nullable Void> startAfterPrevious(
            int robot, Service service, AtomicReference<Integer> reference, ServiceCycle.Finder finder) {
        ServiceLoop previous = byRobot.get(robot);
        if (previous == null) {
            return start(robot, service, reference, finder);
        }
        if (previous.shouldRun()) {
            throw new IllegalStateException("robot " + (robot + 1) + " is in the charge of " + previous.service()
                    + " and was to get " + service + ": set the reference of the first to 0 before");
        }
        previous.wake();
        return previous.ended()
                .handle((stopped, error) -> null)
                .thenCompose(free -> startAfterPrevious(robot, service, reference, finder));
    }

    private Promise<@Nullable Void> start(
            int robot, Service service, AtomicReference<Integer> reference, ServiceCycle.Finder finder) {
        ServiceLoop other = byReference.get(reference);
        if (other != null) {
            throw new IllegalStateException("the reference for " + service + " of robot " + (robot + 1) + " belongs to "
                    + other.service() + " of another robot: give each service a reference of its own");
        }
        RobotConnection connection = connections.connect(robot);
        if (service.usesLaser()) {
            try {
                connection.devices().useLaser(); // a service outside the table is not covered by table.usesLaser
            } catch (PlayerException refused) {
                connections.serviceEnded(robot, true);
                throw refused;
            }
        }
        var loop = new ServiceLoop(
                space, robot, service, connection, reference, finder, observer, connections.takeReconnected(robot));
        byRobot.put(robot, loop);
        byReference.put(reference, loop);
        return loop.ended().whenComplete((stopped, error) -> {
            byRobot.remove(robot, loop);
            byReference.remove(reference, loop);
            connections.serviceEnded(robot, error instanceof PlayerException);
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
        connections.closeAll();
    }

    /**
     * The connections of a {@link RobotServices}: one per robot, or one per service. <b>Threads.</b> The actor space's
     * thread.
     */
    private static final class RobotConnections {
        private final RobotServices.Settings settings;
        private final ActorSpace space;
        private final Map<Integer, RobotConnection> connections = new TreeMap<>();
        private final Set<Integer> reconnecting = new HashSet<>();
        private final List<RobotConnection> closing = new ArrayList<>();

        RobotConnections(RobotServices.Settings settings, ActorSpace space) {
            this.settings = settings;
            this.space = space;
        }

        /** Returns the connection with a robot; connects if there is none. */
        RobotConnection connect(int robot) {
            return connections.computeIfAbsent(
                    robot,
                    index -> RobotConnection.connect(
                            settings.host(),
                            settings.port(),
                            index,
                            settings.table().usesLaser(index)));
        }

        /** Whether the robot's new connection replaces an earlier one; true at most once per connection. */
        boolean takeReconnected(int robot) {
            return reconnecting.remove(robot);
        }

        /**
         * Called when a robot's service has ended. If each service has a separate connection, or the connection has
         * failed, the connection is closed, but only when the space is idle and so after the next service has
         * connected. In lock step a server behind a socket does not wait for a client that has left; the world would
         * advance before the new connection exists. (A server in this JVM waits for the end of the turn.)
         */
        void serviceEnded(int robot, boolean connectionFailed) {
            RobotConnection connection = connectionFailed || settings.reconnects() ? connections.remove(robot) : null;
            if (connection != null) { // also null if all connections are closed already
                reconnecting.add(robot);
                closing.add(connection);
                space.onIdle(this::closePending);
            }
        }

        void closeAll() {
            closing.addAll(connections.values());
            connections.clear();
            closePending();
        }

        private void closePending() {
            closing.forEach(RobotConnection::close);
            closing.clear();
        }
    }
}
