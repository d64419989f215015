/** Structures of the Player interface imu: an inertial sensor. This client does not use them. */
@NullMarked
package io.troupe.player.structures.imu;

import org.jspecify.annotations.NullMarked;
