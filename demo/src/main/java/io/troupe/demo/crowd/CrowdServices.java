package io.troupe.demo.crowd;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTableReader;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/**
 * Creates the services of a crowd, any number of them: the space wanderer, the wall follower, then patrols with
 * obstacle avoidance.
 *
 * <p><b>Units and shapes.</b> A patrol drives between its robot's start pose and a target 2 m to 5 m away. Each patrol
 * has a different direction. In the world of a crowd odometry starts at zero, so the route stays in the robot's hall.
 */
final class CrowdServices {
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
