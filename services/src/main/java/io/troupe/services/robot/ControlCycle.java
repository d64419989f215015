package io.troupe.services.robot;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.Velocity;
import java.util.Optional;
import java.util.function.Consumer;

/**
 * The control cycle of a behaviour: one step for each reading, at most one every
 * {@value io.troupe.services.behaviour.ReadingTime#CYCLE_SECONDS} s, and zero speed at the end or at a failure.
 *
 * <p><b>Threads.</b> One thread at a time.
 */
public final class ControlCycle {
    private final Behaviour behaviour;
    private final Consumer<Velocity> wheels;
    private double lastSeconds = Double.NEGATIVE_INFINITY;
    private boolean halted;

    /** @param wheels receives zero speed when the behaviour ends or fails */
    public ControlCycle(Behaviour behaviour, Consumer<Velocity> wheels) {
        this.behaviour = behaviour;
        this.wheels = wheels;
    }

    /** Whether the previous cycle is over at the time of a reading; readings that come more often are skipped. */
    public boolean isDue(double timeSeconds) {
        return ReadingTime.isCycle(lastSeconds, timeSeconds);
    }

    /**
     * Runs one step of the behaviour.
     *
     * @return the velocity that the behaviour wants, which the caller passes on
     * @throws RuntimeException if the behaviour does; zero speed has been sent before that
     * @throws Error likewise
     */
    public Optional<Velocity> step(Senses senses) {
        lastSeconds = senses.timeSeconds();
        halted = false;
        try {
            return behaviour.step(senses);
        } catch (RuntimeException | Error thrown) {
            try {
                halt();
            } catch (RuntimeException unreachable) {
                thrown.addSuppressed(unreachable);
            }
            throw thrown;
        }
    }

    /** Sends zero speed, unless that was done after the last step. */
    public void halt() {
        if (!halted) {
            halted = true;
            wheels.accept(Velocity.STOP);
        }
    }
}
