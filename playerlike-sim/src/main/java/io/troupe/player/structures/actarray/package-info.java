/** Structures of the Player interface actarray: an array of actuators. This client does not use them. */
@NullMarked
package io.troupe.player.structures.actarray;

import org.jspecify.annotations.NullMarked;
