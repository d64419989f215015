package io.troupe.demo.crowd;

/**
 * The measured cost of one crowd run.
 *
 * @param wallNanos from the first measured tick to the last
 * @param processorNanos of all threads, including compiler and garbage collector
 * @param worldNanos processor time of the thread that advances the world
 * @param servicesNanos processor time of the actor space's thread: frames, Player clients, services, arbitrator
 * @param retainedBytes heap retained by the whole crowd: world, connections, actors
 * @param states number of states that started in the measured ticks
 */
record TrialResult(
        int robots,
        long ticks,
        long intervalMicros,
        long wallNanos,
        long processorNanos,
        long worldNanos,
        long servicesNanos,
        long retainedBytes,
        int states) {
    /** By the wall clock. */
    double timesRealTime() {
        return ticks * intervalMicros * 1000.0 / wallNanos;
    }

    /** By the processor time of all threads: the speed on one core without other programs. */
    double timesRealTimeOfOneCore() {
        return ticks * intervalMicros * 1000.0 / processorNanos;
    }

    double micros() {
        return perRobotAndTick(processorNanos);
    }

    double worldMicros() {
        return perRobotAndTick(worldNanos);
    }

    double servicesMicros() {
        return perRobotAndTick(servicesNanos);
    }

    private double perRobotAndTick(long nanos) {
        return nanos / 1000.0 / robots / ticks;
    }

    double retainedKilobytesPerRobot() {
        return retainedBytes / 1000.0 / robots;
    }
}
