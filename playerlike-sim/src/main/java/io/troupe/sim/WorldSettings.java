package io.troupe.sim;

/**
 * How a world is run, as opposed to what is in it.
 *
 * <p><b>Units and shapes.</b> Metres, radians, microseconds; speeds in m/s and rad/s.
 *
 * @param seed every random draw of the world follows from it
 * @param jitterM each start position is moved by at most this far along x and along y; 0 = off
 * @param jitterRad each start heading is turned by at most this much; 0 = off
 * @param physicsStepMicros one step of the physics; divides the world's interval
 * @param maxForwardMps commands are clamped to plus or minus this speed
 * @param maxTurnRadps commands are clamped to plus or minus this turn rate
 * @param sensingThreads how many threads read devices, that of the caller among them; changes nothing but the speed
 */
public record WorldSettings(
        long seed,
        double jitterM,
        double jitterRad,
        int physicsStepMicros,
        double maxForwardMps,
        double maxTurnRadps,
        int sensingThreads) {
    /** Seed 1, no jitter, 10 ms steps, 5 m/s and 10 rad/s at most, one thread. */
    public static final WorldSettings DEFAULT = new WorldSettings(1, 0, 0, 10_000, 5, 10, 1);

    public WorldSettings {
        requireAtLeastZero("jitterM", jitterM);
        requireAtLeastZero("jitterRad", jitterRad);
        requireAtLeastZero("maxForwardMps", maxForwardMps);
        requireAtLeastZero("maxTurnRadps", maxTurnRadps);
        if (physicsStepMicros < 1) {
            throw new IllegalArgumentException("physicsStepMicros is " + physicsStepMicros + ", expected at least 1");
        }
        if (sensingThreads < 1) {
            throw new IllegalArgumentException("sensingThreads is " + sensingThreads + ", expected at least 1");
        }
    }

    public WorldSettings withSeed(long seed) {
        return new WorldSettings(
                seed, jitterM, jitterRad, physicsStepMicros, maxForwardMps, maxTurnRadps, sensingThreads);
    }

    public WorldSettings withJitter(double jitterM, double jitterRad) {
        return new WorldSettings(
                seed, jitterM, jitterRad, physicsStepMicros, maxForwardMps, maxTurnRadps, sensingThreads);
    }

    public WorldSettings withPhysicsStepMicros(int physicsStepMicros) {
        return new WorldSettings(
                seed, jitterM, jitterRad, physicsStepMicros, maxForwardMps, maxTurnRadps, sensingThreads);
    }

    public WorldSettings withLimits(double maxForwardMps, double maxTurnRadps) {
        return new WorldSettings(
                seed, jitterM, jitterRad, physicsStepMicros, maxForwardMps, maxTurnRadps, sensingThreads);
    }

    public WorldSettings withSensingThreads(int sensingThreads) {
        return new WorldSettings(
                seed, jitterM, jitterRad, physicsStepMicros, maxForwardMps, maxTurnRadps, sensingThreads);
    }

    private static void requireAtLeastZero(String name, double value) {
        if (!(value >= 0 && value < Double.POSITIVE_INFINITY)) {
            throw new IllegalArgumentException(name + " is " + value + ", expected a finite number, 0 or more");
        }
    }
}
