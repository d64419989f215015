/** Structures of the Player interface bumper: bumpers. */
@NullMarked
package io.troupe.player.structures.bumper;

import org.jspecify.annotations.NullMarked;
