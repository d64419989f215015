/** Structures of the position2d interface: odometry and drive. */
@NullMarked
package io.troupe.player.structures.position2d;

import org.jspecify.annotations.NullMarked;
