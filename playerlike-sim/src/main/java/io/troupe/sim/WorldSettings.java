package io.troupe.sim;

/**
 * How a world is run, as opposed to what is in it.
 *
 * <p><b>Units and shapes.</b> Metres, radians, microseconds; speeds in m/s and rad/s.
 *
 * @param seed seed of all random numbers of the world
 * @param jitterM largest random offset of a start position along x and along y; 0 = off
 * @param jitterRad largest random offset of a start heading; 0 = off
 * @param physicsStepMicros one step of the physics; divides the world's interval. It is divided into shorter steps if a
 *     robot could travel farther than half of its length or width in it, because walls would not stop it
 * @param maxForwardMps commands are clamped to plus or minus this speed
 * @param maxTurnRadps commands are clamped to plus or minus this turn rate
 * @param watchdogMicros simulated time without a speed command after which a robot stops; 0 = off. A robot on its way
 *     to a goal goes on
 * @param sensingThreads number of threads that may read devices, including the caller's; it changes only the speed. A
 *     world measures now and then whether they are faster than one, and otherwise leaves them waiting
 * @param obeysAccelerationBounds robots change their speed at each interval by no more than the
 *     {@code acceleration_bounds} of the world file allow; off, they reach a commanded speed at once, as in Stage
 */
public record WorldSettings(
        long seed,
        double jitterM,
        double jitterRad,
        int physicsStepMicros,
        double maxForwardMps,
        double maxTurnRadps,
        long watchdogMicros,
        int sensingThreads,
        boolean obeysAccelerationBounds) {
    /** Seed 1, no jitter, 10 ms steps, 5 m/s and 10 rad/s at most, no watchdog, one thread, no acceleration bounds. */
    public static final WorldSettings DEFAULT = new WorldSettings(1, 0, 0, 10_000, 5, 10, 0, 1, false);

    private static final String ACCELERATION = "acceleration";

    public WorldSettings {
        requireAtLeastZero("jitterM", jitterM);
        requireAtLeastZero("jitterRad", jitterRad);
        requireAtLeastZero("maxForwardMps", maxForwardMps);
        requireAtLeastZero("maxTurnRadps", maxTurnRadps);
        if (physicsStepMicros < 1) {
            throw new IllegalArgumentException("physicsStepMicros is " + physicsStepMicros + ", expected at least 1");
        }
        if (watchdogMicros < 0) {
            throw new IllegalArgumentException("watchdogMicros is " + watchdogMicros + ", expected 0 or more");
        }
        if (sensingThreads < 1) {
            throw new IllegalArgumentException("sensingThreads is " + sensingThreads + ", expected at least 1");
        }
    }

    public WorldSettings withSeed(long seed) {
        return new WorldSettings(
                seed,
                jitterM,
                jitterRad,
                physicsStepMicros,
                maxForwardMps,
                maxTurnRadps,
                watchdogMicros,
                sensingThreads,
                obeysAccelerationBounds);
    }

    public WorldSettings withJitter(double jitterM, double jitterRad) {
        return new WorldSettings(
                seed,
                jitterM,
                jitterRad,
                physicsStepMicros,
                maxForwardMps,
                maxTurnRadps,
                watchdogMicros,
                sensingThreads,
                obeysAccelerationBounds);
    }

    public WorldSettings withPhysicsStepMicros(int physicsStepMicros) {
        return new WorldSettings(
                seed,
                jitterM,
                jitterRad,
                physicsStepMicros,
                maxForwardMps,
                maxTurnRadps,
                watchdogMicros,
                sensingThreads,
                obeysAccelerationBounds);
    }

    public WorldSettings withLimits(double maxForwardMps, double maxTurnRadps) {
        return new WorldSettings(
                seed,
                jitterM,
                jitterRad,
                physicsStepMicros,
                maxForwardMps,
                maxTurnRadps,
                watchdogMicros,
                sensingThreads,
                obeysAccelerationBounds);
    }

    public WorldSettings withWatchdogMicros(long watchdogMicros) {
        return new WorldSettings(
                seed,
                jitterM,
                jitterRad,
                physicsStepMicros,
                maxForwardMps,
                maxTurnRadps,
                watchdogMicros,
                sensingThreads,
                obeysAccelerationBounds);
    }

    public WorldSettings withSensingThreads(int sensingThreads) {
        return new WorldSettings(
                seed,
                jitterM,
                jitterRad,
                physicsStepMicros,
                maxForwardMps,
                maxTurnRadps,
                watchdogMicros,
                sensingThreads,
                obeysAccelerationBounds);
    }

    public WorldSettings withAccelerationBounds(boolean obeyed) {
        return new WorldSettings(
                seed,
                jitterM,
                jitterRad,
                physicsStepMicros,
                maxForwardMps,
                maxTurnRadps,
                watchdogMicros,
                sensingThreads,
                obeyed);
    }

    /** The settings that change the run, as words in record order; the last one only if it is not the default. */
    String words() {
        return seed + " " + jitterM + " " + jitterRad + " " + physicsStepMicros + " " + maxForwardMps + " "
                + maxTurnRadps + " " + watchdogMicros + (obeysAccelerationBounds ? " " + ACCELERATION : "");
    }

    /** Parses the result of {@link #words}. */
    static WorldSettings parse(String words) {
        String[] each = words.split(" ", -1);
        boolean acceleration = each.length == 8 && each[7].equals(ACCELERATION);
        if (each.length != 7 && !acceleration) {
            throw new IllegalArgumentException("'" + words + "', expected seven settings");
        }
        return new WorldSettings(
                Long.parseLong(each[0]),
                Double.parseDouble(each[1]),
                Double.parseDouble(each[2]),
                Integer.parseInt(each[3]),
                Double.parseDouble(each[4]),
                Double.parseDouble(each[5]),
                Long.parseLong(each[6]),
                1,
                acceleration);
    }

    private static void requireAtLeastZero(String name, double value) {
        if (!(value >= 0 && value < Double.POSITIVE_INFINITY)) {
            throw new IllegalArgumentException(name + " is " + value + ", expected a finite number, 0 or more");
        }
    }
}
