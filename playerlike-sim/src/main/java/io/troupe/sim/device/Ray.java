package io.troupe.sim.device;

/** Query and result of the {@link RayCaster}; reused for each ray. */
final class Ray {
    /** Bits of {@link #kind}. */
    static final int RANGE = 1;

    static final int SIGHT = 2;
    /** The rays of grippers. */
    static final int GRIP = 4;

    static final int NOTHING = -1;

    double x;
    double y;
    /** Unit vector, with {@link #dirY}. */
    double dirX;

    double dirY;
    double maxM;
    /** Bit that {@link Segments#stops} must find in a segment's kinds. */
    int kind;
    /** Number of the thing that the ray ignores. */
    int skip = NOTHING;

    /** Result: number of the first thing in range, or {@link #NOTHING}. */
    int hitThing;

    /** Result: distance of that thing; infinite if there is none. */
    double hitM;
}
