package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Velocity;
import io.troupe.services.robot.ControlCycle;
import io.troupe.services.robot.PlayerRobot;
import java.util.function.Consumer;

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
    private final Consumer<Velocity> wheels;
    private final ControlCycle control;
    private final ServiceObserver observer;
    private double startSeconds = Double.NaN;

    /** @param wheels receives the velocities, usually {@code robot::drive} */
    ServiceCycle(Service service, PlayerRobot robot, Consumer<Velocity> wheels, ServiceObserver observer) {
        this.service = service;
        this.robot = robot;
        this.wheels = wheels;
        this.control = new ControlCycle(service.behaviour().get(), wheels);
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
            wheels.accept(control.step(robot.senses(service.usesLaser())).orElse(Velocity.STOP));
        }
        observer.cycleEnded(robot.index(), service);
        return goesOn;
    }

    /** Sends zero speed. */
    void halt() {
        control.halt();
    }
}
