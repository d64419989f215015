package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Velocity;
import io.troupe.services.robot.ControlCycle;
import io.troupe.services.robot.PlayerRobot;

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
        Finder NONE = (robot, secondsInCharge) -> true;

        /**
         * Looks for colours in the newest reading.
         *
         * @return whether the service goes on; if not, the behaviour is not called in this cycle
         */
        boolean look(PlayerRobot robot, double secondsInCharge);
    }

    private final Service service;
    private final PlayerRobot robot;
    private final ControlCycle control;
    private final ServiceObserver observer;
    private double startSeconds = Double.NaN;

    ServiceCycle(Service service, PlayerRobot robot, ServiceObserver observer) {
        this.service = service;
        this.robot = robot;
        this.control = new ControlCycle(service.behaviour().get(), robot::drive);
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
        startSeconds = robot.timeSeconds();
    }

    /** Whether the previous cycle is over; readings that come more often are skipped. */
    boolean isDue() {
        return control.isDue(robot.timeSeconds());
    }

    /** Runs one cycle; returns whether the service goes on. */
    boolean run(Finder finder) {
        observer.cycleStarted(robot.index(), service);
        if (Double.isNaN(startSeconds)) {
            start();
        }
        boolean goesOn = finder.look(robot, robot.timeSeconds() - startSeconds);
        if (goesOn) {
            robot.drive(control.step(robot.senses(service.usesLaser())).orElse(Velocity.STOP));
        }
        observer.cycleEnded(robot.index(), service);
        return goesOn;
    }

    /** Sends zero speed. */
    void halt() {
        control.halt();
    }
}
