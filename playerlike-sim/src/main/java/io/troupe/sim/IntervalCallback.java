package io.troupe.sim;

/**
 * Callback that drives robots from within {@link World#advance(long, IntervalCallback)}.
 *
 * <p><b>Threads.</b> Called by the thread that advances the world.
 *
 * <p><b>Errors.</b> An exception ends the advance, before the interval for which the controller was called.
 */
@FunctionalInterface
public interface IntervalCallback {
    /** Called before each interval to read the sensors and to give the commands for that interval. */
    void control(WorldView view);
}
