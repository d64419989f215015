/** Structures of the Player interface position1d: a linear actuator. This client does not use them. */
@NullMarked
package io.troupe.player.structures.position1d;

import org.jspecify.annotations.NullMarked;
