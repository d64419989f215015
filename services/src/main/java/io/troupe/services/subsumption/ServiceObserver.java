package io.troupe.services.subsumption;

/** Is told what the services do. Called on the thread that does it; robots are numbered by Player index, from 0. */
public interface ServiceObserver {
    /**
     * A service has taken charge of a robot: at once when it begins, or, on a connection of its own that replaces
     * another's, with its first reading.
     */
    void began(int robot, Service service);

    /** A reading has come, and the service's cycle begins. */
    default void cycleBegins(int robot, Service service) {}

    /** A service has finished a cycle. */
    void cycled(int robot, Service service);

    /**
     * A service is not in charge any more, and has sent zero speed, unless in synchronous mode another one takes its
     * place.
     */
    void ended(int robot, Service service);

    /**
     * A robot's colour finder sends a colour to the arbitrator, as a message of its own; never in synchronous mode,
     * which has none.
     */
    default void colourSent(int robot, int colour) {}

    /** Looks away. */
    ServiceObserver NONE = new ServiceObserver() {
        @Override
        public void began(int robot, Service service) {}

        @Override
        public void cycled(int robot, Service service) {}

        @Override
        public void ended(int robot, Service service) {}
    };
}
