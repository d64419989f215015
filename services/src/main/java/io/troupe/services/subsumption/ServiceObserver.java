package io.troupe.services.subsumption;

/** Is told what the services do. Called on the actor space's thread; robots are numbered by Player index, from 0. */
public interface ServiceObserver {
    /** A service has taken charge of a robot. */
    void began(int robot, Service service);

    /** A service has finished a cycle. */
    void cycled(int robot, Service service);

    /** A service has sent zero speed and is not in charge any more. */
    void ended(int robot, Service service);

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
