package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.NamedColours;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;

/** Which services run for a measurement. */
final class Tables {
    private Tables() {}

    /**
     * Robot 1 follows walls and robot 2 wanders for ever: blue is the only colour that leads anywhere, and it leads
     * here.
     */
    static SubsumptionTable oneState() {
        return SubsumptionTable.forRobots(2)
                .when(NamedColours.BLUE, Service.WALL_FOLLOWER, Service.SPACE_WANDERER)
                .build();
    }

    /** Robot 1 alone, for ever. */
    static SubsumptionTable alone(Service service) {
        return SubsumptionTable.forRobots(1)
                .when(NamedColours.BLUE, service)
                .allowFinal()
                .build();
    }
}
