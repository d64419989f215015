package io.troupe.view.live;

import io.troupe.sim.Snapshot;

/**
 * A world at a tick, as it is shown.
 *
 * @param number counts the frames of a world from 0
 * @param states a word for each robot: the number of the service that drives it, or a value of this class, and flags
 * @param speed simulated seconds per second, as measured; 0 = not known
 */
record ViewFrame(long number, Snapshot snapshot, short[] states, double speed) {
    /** No service drives the robot. */
    static final int NO_SERVICE = 0;

    /** The first service. */
    static final int FIRST_SERVICE = 1;

    /** More than one service drives the robot, or one without a number. */
    static final int OTHER_SERVICE = 255;

    static final int STALLED = 0x100;
    static final int TOUCHED = 0x200;
    static final int DRIVEN_BY_HAND = 0x400;

    /** The robot was taken out of the world. */
    static final int AWAY = 0x800;

    /** From this bit on: how often the robot was put elsewhere, modulo 16. */
    static final int JUMPS_SHIFT = 12;
}
