package io.troupe.demo.crowd;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Service;
import java.util.List;

/** The services of a crowd, as many as one likes. */
final class CrowdServices {
    private CrowdServices() {}

    /** The wanderer, the wall follower. */
    static List<Service> first(int count, CornerStyle corners) {
        return List.of(Service.SPACE_WANDERER, Service.wallFollower(corners)).subList(0, Math.min(2, count));
    }
}
