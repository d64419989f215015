package io.troupe.demo.crowd;

/**
 * What one run of a crowd cost.
 *
 * @param wallNanos from the first measured tick to the last
 * @param processorNanos of all threads, the compiler's and the collector's included
 * @param worldNanos processor time of the thread that moves the world
 * @param servicesNanos processor time of the actor space's thread: frames, Player clients, services, arbitrator
 * @param retainedBytes of the heap, by the whole crowd: world, connections, actors
 * @param states that began in the measured ticks
 */
record Trial(
        int robots,
        long ticks,
        long intervalMicros,
        long wallNanos,
        long processorNanos,
        long worldNanos,
        long servicesNanos,
        long retainedBytes,
        int states) {
    /** By the clock on the wall. */
    double timesRealTime() {
        return ticks * intervalMicros * 1000.0 / wallNanos;
    }

    /** By the processor time of all threads: what one core does that nobody else uses. */
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
