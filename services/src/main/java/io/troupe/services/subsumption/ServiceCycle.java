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
        Finder NONE = (devices, secondsInCharge) -> {};

        /**
         * Looks for colours in the newest reading. It may end the service; then the behaviour is not called in this
         * cycle.
         */
        void look(PlayerDevices devices, double secondsInCharge);
    }

    private final int robot;
    private final Service service;
    private final PlayerDevices devices;
    private final Behaviour behaviour;
    private final ServiceObserver observer;
    private double lastCycleSeconds = Double.NEGATIVE_INFINITY;
    private double startSeconds = Double.NaN;

    ServiceCycle(int robot, Service service, PlayerDevices devices, ServiceObserver observer) {
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
    void start() {
        startSeconds = devices.timeSeconds();
    }

    /** Whether the previous cycle is over; readings that come more often are skipped. */
    boolean isDue() {
        return ReadingTime.isCycle(lastCycleSeconds, devices.timeSeconds());
    }

    /**
     * Runs one cycle.
     *
     * @param drives whether the service still drives the robot after the finder has run
     */
    void run(Finder finder, BooleanSupplier drives) {
        observer.cycleStarted(robot, service);
        lastCycleSeconds = devices.timeSeconds();
        if (Double.isNaN(startSeconds)) {
            start();
        }
        finder.look(devices, lastCycleSeconds - startSeconds);
        if (drives.getAsBoolean()) {
            devices.drive(behaviour.step(devices.senses(service.usesLaser())).orElse(Velocity.STOP));
        }
        observer.cycleEnded(robot, service);
    }

    /** Sends zero speed. */
    void halt() {
        devices.drive(Velocity.STOP);
    }
}
