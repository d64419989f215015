/** Structures of the Player interface bumper: bumpers. This client does not use them. */
@NullMarked
package io.troupe.player.structures.bumper;

import org.jspecify.annotations.NullMarked;
