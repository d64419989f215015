/** Structures of an inertial sensor; no device here uses them. */
@NullMarked
package io.troupe.player.structures.imu;

import org.jspecify.annotations.NullMarked;
