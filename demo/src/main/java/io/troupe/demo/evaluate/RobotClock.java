package io.troupe.demo.evaluate;

/** The robots' clock, in nanoseconds. */
interface RobotClock {
    long nanos();

    /**
     * End of a cycle whose computation has just finished. In lock step no time passes while services compute, so this
     * is the end of the interval in which the command takes effect. Otherwise it is the current time.
     */
    long endOfCycleNanos();
}
