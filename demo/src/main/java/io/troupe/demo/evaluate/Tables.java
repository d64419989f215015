package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Colours;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;

/** The subsumption tables of measurements. */
final class Tables {
    private Tables() {}

    /**
     * One state that never ends: robot 1 follows walls, robot 2 wanders. Blue is the only colour with a state, and
     * leads to this one.
     */
    static SubsumptionTable oneState() {
        return SubsumptionTable.forRobots(2)
                .when(Colours.BLUE, Service.WALL_FOLLOWER, Service.SPACE_WANDERER)
                .build();
    }

    /** Robot 1 alone, in one state that never ends. */
    static SubsumptionTable alone(Service service) {
        return SubsumptionTable.forRobots(1)
                .when(Colours.BLUE, service)
                .allowFinal()
                .build();
    }
}
