package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.player.PlayerException;
import io.troupe.services.robot.RobotConnection;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

/**
 * The connections of robot services with their robots: one per robot, or one per service.
 *
 * <p><b>Threads.</b> The space of the services.
 */
final class RobotConnections {
    private final RobotServicesActor.Settings settings;
    private final Duration silenceLimit;
    private final Map<Integer, RobotConnection> open = new TreeMap<>(); // by robot
    private final Set<Integer> reconnecting = new HashSet<>();
    private final List<RobotConnection> closing = new ArrayList<>();

    /** @param silenceLimit a server that is silent for so long has gone */
    RobotConnections(RobotServicesActor.Settings settings, Duration silenceLimit) {
        this.settings = settings;
        this.silenceLimit = silenceLimit;
    }

    /** Returns the connection with a robot; connects if there is none. */
    RobotConnection connect(int robot) {
        return open.computeIfAbsent(robot, index -> {
            var devices =
                    new RobotConnection.Devices(index, true, settings.table().usesLaser(index));
            var connection = RobotConnection.open(
                    settings.host(), settings.port(), RobotConnection.Delivery.PULL, List.of(devices), silenceLimit);
            connection.readOnSpace();
            return connection;
        });
    }

    /**
     * Connects to all robots of the table.
     *
     * @throws PlayerException if one cannot be reached; then there is no connection
     */
    void connectAll() {
        try {
            for (int robot = 0; robot < settings.table().robots(); robot++) {
                connect(robot);
            }
        } catch (PlayerException unreachable) {
            closeAll();
            throw unreachable;
        }
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
    void serviceEnded(int robot, boolean connectionFailed, ActorSpace space) {
        RobotConnection ended = connectionFailed || settings.reconnects() ? open.remove(robot) : null;
        if (ended != null) { // also null if all connections are closed already
            reconnecting.add(robot);
            closing.add(ended);
            space.onIdle(this::closePending);
        }
    }

    void closeAll() {
        closing.addAll(open.values());
        open.clear();
        closePending();
    }

    private void closePending() {
        closing.forEach(RobotConnection::close);
        closing.clear();
    }
}
