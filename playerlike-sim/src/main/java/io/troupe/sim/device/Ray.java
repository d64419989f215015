package io.troupe.sim.device;

/** A question to the {@link RayCaster} and its answer; reused from ray to ray. */
final class Ray {
    /** Bits for {@link #kind}. */
    static final int RANGE = 1;

    static final int SIGHT = 2;
    static final int NOTHING = -1;

    double x;
    double y;
    /** With {@link #dirY} a vector of length 1. */
    double dirX;

    double dirY;
    double maxM;
    /** The bit that a segment's {@code stops} must have. */
    int kind;
    /** Number of the thing the ray ignores. */
    int skip = NOTHING;

    /** Answer: number of the first thing in reach, or {@link #NOTHING}. */
    int hitThing;

    /** Answer: how far away it is; infinite if there is none. */
    double hitM;
}
