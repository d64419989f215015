package io.troupe.sim;

import io.troupe.actor.Settings;
import org.jspecify.annotations.Nullable;

/**
 * How a world is run, as opposed to what is in it.
 *
 * <p><b>Units and shapes.</b> Metres, radians, microseconds; speeds in m/s and rad/s.
 */
public final class WorldSettings extends Settings<WorldSettings> {
    private static final WorldSettings DEFAULTS = new WorldSettings();
    private static final String ACCELERATION = "acceleration";

    private long seed = 1;
    private double jitterM;
    private double jitterRad;
    private int physicsStepMicros = 10_000;
    private double maxForwardMps = 5;
    private double maxTurnRadps = 10;
    private long watchdogMicros;
    private int sensingThreads = 1;
    private boolean obeysAccelerationBounds;

    private WorldSettings() {}

    /** Seed 1, no jitter, 10 ms steps, 5 m/s and 10 rad/s at most, no watchdog, one thread, no acceleration bounds. */
    public static WorldSettings defaults() {
        return DEFAULTS;
    }

    @Override
    protected void check() {
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

    /** The seed of all random numbers of the world. */
    public WorldSettings withSeed(long newSeed) {
        return with(copy -> copy.seed = newSeed);
    }

    /** The largest random offset of a start position along x and along y, and of a start heading; 0 = off. */
    public WorldSettings withJitter(double newJitterM, double newJitterRad) {
        return with(copy -> {
            copy.jitterM = newJitterM;
            copy.jitterRad = newJitterRad;
        });
    }

    /**
     * One step of the physics; divides the world's interval. It is divided into shorter steps if a robot could travel
     * farther than half of its length or width in it, because walls would not stop it.
     */
    public WorldSettings withPhysicsStepMicros(int micros) {
        return with(copy -> copy.physicsStepMicros = micros);
    }

    /** Commands are clamped to plus or minus this speed and turn rate. */
    public WorldSettings withLimits(double forwardMps, double turnRadps) {
        return with(copy -> {
            copy.maxForwardMps = forwardMps;
            copy.maxTurnRadps = turnRadps;
        });
    }

    /**
     * The simulated time without a speed command after which a robot stops; 0 = off. A robot on its way to a goal goes
     * on.
     */
    public WorldSettings withWatchdogMicros(long micros) {
        return with(copy -> copy.watchdogMicros = micros);
    }

    /**
     * The number of threads that may read devices, including the caller's; it changes only the speed. A world measures
     * now and then whether they are faster than one, and otherwise leaves them waiting.
     */
    public WorldSettings withSensingThreads(int threads) {
        return with(copy -> copy.sensingThreads = threads);
    }

    /**
     * Robots change their speed at each interval by no more than the {@code acceleration_bounds} of the world file
     * allow; off, they reach a commanded speed at once, as in Stage.
     */
    public WorldSettings withAccelerationBounds(boolean obeyed) {
        return with(copy -> copy.obeysAccelerationBounds = obeyed);
    }

    public long seed() {
        return seed;
    }

    public double jitterM() {
        return jitterM;
    }

    public double jitterRad() {
        return jitterRad;
    }

    public int physicsStepMicros() {
        return physicsStepMicros;
    }

    public double maxForwardMps() {
        return maxForwardMps;
    }

    public double maxTurnRadps() {
        return maxTurnRadps;
    }

    public long watchdogMicros() {
        return watchdogMicros;
    }

    public int sensingThreads() {
        return sensingThreads;
    }

    public boolean obeysAccelerationBounds() {
        return obeysAccelerationBounds;
    }

    /** The settings that change the run, as words; the last one only if it is not the default. */
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
        return defaults()
                .withSeed(Long.parseLong(each[0]))
                .withJitter(Double.parseDouble(each[1]), Double.parseDouble(each[2]))
                .withPhysicsStepMicros(Integer.parseInt(each[3]))
                .withLimits(Double.parseDouble(each[4]), Double.parseDouble(each[5]))
                .withWatchdogMicros(Long.parseLong(each[6]))
                .withAccelerationBounds(acceleration);
    }

    /** Equal to settings that give the same run, with as many threads. */
    @Override
    public boolean equals(@Nullable Object other) {
        return other instanceof WorldSettings that
                && words().equals(that.words())
                && sensingThreads == that.sensingThreads;
    }

    @Override
    public int hashCode() {
        return words().hashCode();
    }

    @Override
    public String toString() {
        return words() + ", " + sensingThreads + " threads";
    }

    private static void requireAtLeastZero(String name, double value) {
        if (!(value >= 0 && value < Double.POSITIVE_INFINITY)) {
            throw new IllegalArgumentException(name + " is " + value + ", expected a finite number, 0 or more");
        }
    }
}
