package io.troupe.demo.evaluate;

/** The robots' clock, in nanoseconds. */
interface RobotTime {
    long nanos();

    /**
     * When a cycle that has just done its computing ends: in lock step, where no time passes while services compute,
     * with the interval at whose end its command has worked; else now.
     */
    long endOfCycleNanos();
}
