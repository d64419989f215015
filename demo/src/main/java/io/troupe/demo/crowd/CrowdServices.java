package io.troupe.demo.crowd;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTableReader;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/**
 * The services of a crowd, as many as one likes: the wanderer, the wall follower, and then patrols, which avoid what is
 * in their way.
 *
 * <p><b>Units and shapes.</b> A patrol goes to and fro between where its robot started and a point of its own, from 2 m
 * to 5 m away, the next one's always in another direction. Odometry begins at zero in a crowd's world, so that every
 * robot has such a way in its own hall.
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

    /** In the words of a table's file, so that it can be written into one. */
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
