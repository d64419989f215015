package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.Velocity;
import java.util.function.BooleanSupplier;

/**
 * The control cycle of a service: looks for colours, steps the behaviour, and commands the velocity. The same in all
 * three modes.
 */
final class ServiceCycle {
    /** A robot's colour finder in one cycle. */
    @FunctionalInterface
    interface Finder {
        /**
         * Finds nothing. Used in the first cycle of a service that takes over, because the previous service has already
         * seen that reading.
         */
        Finder LOOKS_AWAY = (devices, secondsInCharge) -> {};

        /**
         * Looks for colours in the newest reading. It may end the service; then the behaviour is not called in this
         * cycle.
         */
        void look(RobotDevices devices, double secondsInCharge);
    }

    private final int robot;
    private final Service service;
    private final RobotDevices devices;
    private final Behaviour behaviour;
    private final ServiceObserver observer;
    private double lastSeconds = Double.NEGATIVE_INFINITY;
    private double beganSeconds = Double.NaN;

    ServiceCycle(int robot, Service service, RobotDevices devices, ServiceObserver observer) {
        this.robot = robot;
        this.service = service;
        this.devices = devices;
        this.behaviour = service.behaviour().get();
        this.observer = observer;
    }

    Service service() {
        return service;
    }

    /**
     * Marks the newest reading as the one at which the service starts to drive the robot. If never called, that is the
     * reading of the first cycle.
     */
    void takeCharge() {
        beganSeconds = devices.timeSeconds();
    }

    /** Whether the previous cycle is over; readings that come more often are skipped. */
    boolean isDue() {
        return ReadingTime.isCycle(lastSeconds, devices.timeSeconds());
    }

    /**
     * Runs one cycle.
     *
     * @param drives whether the service still drives the robot after the finder has run
     */
    void run(Finder finder, BooleanSupplier drives) {
        observer.cycleBegins(robot, service);
        lastSeconds = devices.timeSeconds();
        if (Double.isNaN(beganSeconds)) {
            takeCharge();
        }
        finder.look(devices, lastSeconds - beganSeconds);
        if (drives.getAsBoolean()) {
            devices.drive(behaviour.step(devices.senses(service.usesLaser())).orElse(Velocity.STOP));
        }
        observer.cycled(robot, service);
    }

    /** Sends zero speed. */
    void halt() {
        devices.drive(Velocity.STOP);
    }
}
