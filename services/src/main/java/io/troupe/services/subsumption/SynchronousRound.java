package io.troupe.services.subsumption;

/** How the synchronous mode distributes the readings among the services. */
public enum SynchronousRound {
    /**
     * One service runs at each reading, as in the paper: its cycle takes 100 ms and the next service waits for it, so N
     * robots take N readings per round. After a switch the first robot's cycle runs at the next reading. Until its next
     * cycle a robot keeps its last commanded speed.
     */
    ONE_SERVICE_A_READING,
    /**
     * All services run at every reading, one after the other, as if cycles took no time. The services of a new state
     * run on the newest reading at once.
     */
    ALL_SERVICES_A_READING
}
