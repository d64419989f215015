package io.troupe.sim.physics;

import java.util.Arrays;

/**
 * The touches that began since the last clear, ordered by (time, robot, other robot, obstacle).
 *
 * <p><b>Threads.</b> Those of the {@link Physics} it belongs to.
 */
public final class Touches {
    private final int bodyCount;
    private final int[] movers;
    private final int robotCount;
    private long[] timesMicros = new long[16];
    private long[] pairs = new long[16];
    private int count;

    /**
     * @param bodyCount robots, and after them obstacles that move
     * @param movers the indices of these obstacles
     */
    Touches(int bodyCount, int[] movers) {
        this.bodyCount = bodyCount;
        this.movers = movers;
        robotCount = bodyCount - movers.length;
    }

    /** Adds a touch, unless it is one of two obstacles. */
    void add(long timeMicros, long pair) {
        if (pair >> 32 >= robotCount) {
            return;
        }
        if (count == pairs.length) {
            timesMicros = Arrays.copyOf(timesMicros, 2 * count);
            pairs = Arrays.copyOf(pairs, 2 * count);
        }
        timesMicros[count] = timeMicros;
        pairs[count] = pair;
        count++;
    }

    void clear() {
        count = 0;
    }

    public int count() {
        return count;
    }

    /** Time at the end of the physics step in which the touch began. */
    public long timeMicros(int touch) {
        return timesMicros[touch];
    }

    /** Index of the robot; of two robots the lower index. */
    public int robot(int touch) {
        return (int) (pairs[touch] >> 32);
    }

    /** Index of the other robot, or -1. */
    public int otherRobot(int touch) {
        int second = (int) pairs[touch];
        return second < robotCount ? second : -1;
    }

    /** Index of the obstacle, or -1. */
    public int obstacle(int touch) {
        int second = (int) pairs[touch];
        if (second < robotCount) {
            return -1;
        }
        return second < bodyCount ? movers[second - robotCount] : second - bodyCount;
    }
}
