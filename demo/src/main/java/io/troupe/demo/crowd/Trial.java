package io.troupe.demo.crowd;

/**
 * What one run of a crowd cost.
 *
 * @param wallNanos from the first measured tick to the last
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
        long worldNanos,
        long servicesNanos,
        long retainedBytes,
        int states) {
    double timesRealTime() {
        return ticks * intervalMicros * 1000.0 / wallNanos;
    }

    double microsPerRobotAndTick() {
        return perRobotAndTick(wallNanos);
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
