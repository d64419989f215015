package io.troupe.sim;

/**
 * Drives robots from within {@link World#advance(long, Controller)}.
 *
 * <p><b>Threads.</b> Called by the thread that advances the world.
 *
 * <p><b>Errors.</b> What it throws ends the advance, before the interval it was called for.
 */
@FunctionalInterface
public interface Controller {
    /** Called before each interval, to look at the readings and to command for it. */
    void control(WorldView view);
}
