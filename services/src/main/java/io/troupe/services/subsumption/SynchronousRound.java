package io.troupe.services.subsumption;

/** How the synchronous mode shares the readings among the services. */
public enum SynchronousRound {
    /**
     * Each service's cycle takes 100 ms and the next one waits for it, as in the paper: N robots take N readings a
     * round. A switch is followed by the first robot's cycle on the next reading; until its turn comes a robot rolls on
     * as it was last told.
     */
    ONE_SERVICE_A_READING,
    /**
     * Cycles take no time: all services react to every reading, one after the other, and those of a new state take over
     * with the reading at hand.
     */
    ALL_SERVICES_A_READING
}
