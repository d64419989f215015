package io.troupe.demo.crowd;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.ArrayList;
import java.util.List;

/**
 * The table of a crowd: a state for each colour, in which the services go round among the robots.
 *
 * <p><b>Order.</b> In state k robot r has service (r + k) modulo the number of services, so that each state has all of
 * them if there are robots enough, and every change of state moves them on. If nobody in a state would look for
 * colours, its robot k modulo the number of robots wanders instead: else the state could never end.
 */
public final class CrowdTable {
    /**
     * How long a state lasts at least, unless told otherwise. Among many robots somebody sees another colour at nearly
     * every reading; without a hold all of them would be stopped and started ten times a second, and no service would
     * ever get anywhere.
     */
    public static final double HOLD_SECONDS = 5;

    private CrowdTable() {}

    /**
     * Makes one.
     *
     * @param colours one for each state, the first for the one to begin with
     * @param services how many of the {@link CrowdServices}
     * @param corners of the wall follower
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
