package io.troupe.demo.crowd;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.ArrayList;
import java.util.List;

/**
 * Creates the table of a crowd: one state per colour; the services rotate among the robots.
 *
 * <p><b>Order.</b> In state k, robot r has service (r + k) modulo the number of services. With enough robots each state
 * has all services, and every state change moves them on. If no service of a state looks for colours, robot k modulo
 * the number of robots gets the space wanderer instead: otherwise the state would never end.
 */
public final class CrowdTable {
    /**
     * Default minimum duration of a state. In a large crowd some robot sees another colour at almost every reading.
     * Without a minimum the services would be stopped and restarted ten times a second and make no progress.
     */
    public static final double HOLD_SECONDS = 5;

    private CrowdTable() {}

    /**
     * Creates the table.
     *
     * @param colours one per state; the first one is the initial state
     * @param services number of {@link CrowdServices}
     * @param corners how the wall follower turns at corners
     */
    public static SubsumptionTable of(
            int robots, List<Integer> colours, int services, double holdSeconds, CornerStyle corners) {
        List<Service> known = CrowdServices.first(services, corners);
        var table = SubsumptionTable.forRobots(robots).hold(holdSeconds);
        for (int state = 0; state < colours.size(); state++) {
            table.when(colours.get(state), assignment(robots, known, state).toArray(Service[]::new));
        }
        return table.build();
    }

    private static List<Service> assignment(int robots, List<Service> known, int state) {
        List<Service> assignment = new ArrayList<>(robots);
        for (int robot = 0; robot < robots; robot++) {
            assignment.add(known.get((robot + state) % known.size()));
        }
        if (assignment.stream().noneMatch(Service::findsColours)) {
            assignment.set(state % robots, Service.SPACE_WANDERER);
        }
        return assignment;
    }
}
