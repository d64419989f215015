package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

/**
 * The connections of a {@link RobotServices}: one for each robot, or one for each service. <b>Threads.</b> The space's.
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

    /** The connection with a robot, made if there is none. */
    RobotLink connect(int robot) {
        return links.computeIfAbsent(
                robot,
                index -> RobotLink.connect(
                        settings.host(),
                        settings.port(),
                        index,
                        settings.table().usesLaser(index)));
    }

    /** Whether the connection that has just been made replaces another. */
    boolean takeReconnected(int robot) {
        return reconnecting.remove(robot);
    }

    /**
     * A robot's service has ended. Where each has a connection of its own, or the connection has failed, that is closed
     * when nothing is left to do, and so after the new one is there: in lock step a server behind a socket does not
     * wait for a client that has left; one in this JVM would wait for the end of the turn.
     */
    void serviceEnded(int robot, boolean connectionFailed) {
        RobotLink link = connectionFailed || settings.reconnects() ? links.remove(robot) : null;
        if (link != null) { // null too if all are closed already
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
