package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.Velocity;
import java.util.function.BooleanSupplier;

/** What a service that is in charge of a robot does about a reading; the same in all three modes. */
final class ServiceCycle {
    /** What a robot's colour finder does with what it sees in a cycle. */
    @FunctionalInterface
    interface Finder {
        /** For a reading that the service before has seen too. */
        Finder LOOKS_AWAY = (devices, secondsInCharge) -> {};

        /** Looks; it may end the service, and the behaviour has no say any more. */
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
     * The reading at hand is the one at which the service takes charge; without a call that is the one of its first
     * cycle.
     */
    void takeCharge() {
        beganSeconds = devices.timeSeconds();
    }

    /** Whether the cycle before is over; readings that come more often are passed over. */
    boolean isDue() {
        return ReadingTime.isCycle(lastSeconds, devices.timeSeconds());
    }

    /**
     * One cycle.
     *
     * @param drives whether the service is still to drive when the finder has looked
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
