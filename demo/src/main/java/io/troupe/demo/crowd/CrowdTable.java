package io.troupe.demo.crowd;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

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

    /** The largest number of different services. */
    public static final int MOST_SERVICES = 100;

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
        var table = SubsumptionTable.forRobots(robots).holdSeconds(holdSeconds);
        for (int state = 0; state < colours.size(); state++) {
            table.state(colours.get(state), assignment(robots, known, state).toArray(Service[]::new));
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

    /**
     * Creates the services of a crowd, any number of them: the space wanderer, the wall follower, then patrols with
     * obstacle avoidance.
     *
     * <p><b>Units and shapes.</b> A patrol drives between its robot's start pose and a target 2 m to 5 m away. Each
     * patrol has a different direction. In the world of a crowd odometry starts at zero, so the route stays in the
     * robot's hall.
     */
    private static final class CrowdServices {
        private static final double FIRST_M = 2;
        private static final double MORE_M = 0.5;
        private static final int DISTANCES = 7;
        private static final double TURN_RAD = StrictMath.toRadians(137);

        private CrowdServices() {}

        static List<Service> first(int count, CornerStyle corners) {
            List<Service> services = new ArrayList<>(List.of(Service.SPACE_WANDERER, Service.wallFollower(corners)));
            Service avoid = SubsumptionTableReader.service("avoid = avoid", ServiceCatalogue.standard());
            for (int patrol = 1; services.size() < count; patrol++) {
                services.add(avoid.over(patrol(patrol)));
            }
            return services.subList(0, count);
        }

        /** Created from the words of the table file format, so that it can be written to such a file. */
        private static Service patrol(int number) {
            double distanceM = FIRST_M + number % DISTANCES * MORE_M;
            String declaration = String.format(
                    Locale.ROOT,
                    "patrol%d = goToGoal(%.2f, %.2f; 0, 0; again) colours",
                    number,
                    distanceM * StrictMath.cos(number * TURN_RAD),
                    distanceM * StrictMath.sin(number * TURN_RAD));
            return SubsumptionTableReader.service(declaration, ServiceCatalogue.standard());
        }
    }
}
