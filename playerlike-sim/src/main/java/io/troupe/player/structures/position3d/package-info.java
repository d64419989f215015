/** Structures of the Player interface position3d: a robot that moves in 3D. This client does not use them. */
@NullMarked
package io.troupe.player.structures.position3d;

import org.jspecify.annotations.NullMarked;
