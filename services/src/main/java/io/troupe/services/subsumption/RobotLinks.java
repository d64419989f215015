package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

/**
 * The connections of a {@link RobotServices}: one per robot, or one per service. <b>Threads.</b> The actor space's
 * thread.
 */
final class RobotLinks {
    private final RobotServices.Settings settings;
    private final ActorSpace space;
    private final Map<Integer, RobotLink> links = new TreeMap<>();
    private final Set<Integer> reconnecting = new HashSet<>();
    private final List<RobotLink> leaving = new ArrayList<>();

    RobotLinks(RobotServices.Settings settings, ActorSpace space) {
        this.settings = settings;
        this.space = space;
    }

    /** Returns the connection with a robot; connects if there is none. */
    RobotLink connect(int robot) {
        return links.computeIfAbsent(
                robot,
                index -> RobotLink.connect(
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
        RobotLink link = connectionFailed || settings.reconnects() ? links.remove(robot) : null;
        if (link != null) { // also null if all connections are closed already
            reconnecting.add(robot);
            leaving.add(link);
            space.onIdle(this::closeLeaving);
        }
    }

    void closeAll() {
        leaving.addAll(links.values());
        links.clear();
        closeLeaving();
    }

    private void closeLeaving() {
        leaving.forEach(RobotLink::close);
        leaving.clear();
    }
}
