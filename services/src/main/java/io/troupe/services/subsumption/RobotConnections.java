package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

/**
 * The connections of a {@link RobotServices}: one per robot, or one per service. <b>Threads.</b> The actor
 * space's thread.
 */
final class RobotConnections {
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
     * Called when a robot's service has ended. If each service has a separate connection, or the connection has failed,
     * the connection is closed, but only when the space is idle and so after the next service has connected. In lock
     * step a server behind a socket does not wait for a client that has left; the world would advance before the new
     * connection exists. (A server in this JVM waits for the end of the turn.)
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
