package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Velocity;

/**
 * Notified of what the services do. Called on the thread that runs the service. A {@code robotIndex} is a Player index,
 * from 0.
 */
public interface ServiceObserver {
    /**
     * A service has started to drive a robot. It is called when the service starts; on a new connection that replaces
     * an earlier one, it is called at the first reading.
     */
    void serviceStarted(int robotIndex, Service service);

    /** A new reading has arrived, and the service starts a cycle. */
    default void cycleStarted(int robotIndex, Service service) {}

    /** A speed is sent to a robot now. Never called in synchronous mode. */
    default void commanded(int robotIndex, Service service, Velocity velocity) {}

    /** A service has finished a cycle. */
    void cycleEnded(int robotIndex, Service service);

    /**
     * A service no longer drives the robot, and has sent zero speed. In synchronous mode zero speed is not sent if
     * another service takes over.
     */
    void serviceEnded(int robotIndex, Service service);

    /**
     * A robot's colour finder sends a colour to the arbitrator as a message. Never called in synchronous mode, which
     * sends no messages.
     */
    default void colourSent(int robotIndex, int colour) {}

    /**
     * The lease of a service is over, because its arbitrator has not renewed it in time: the service stops. Called only
     * over hosts.
     */
    default void leaseLost(int robotIndex, Service service) {}

    /** An observer that does nothing. */
    static ServiceObserver none() {
        return new ServiceObserver() {
            @Override
            public void serviceStarted(int robotIndex, Service service) {}

            @Override
            public void cycleEnded(int robotIndex, Service service) {}

            @Override
            public void serviceEnded(int robotIndex, Service service) {}
        };
    }
}
