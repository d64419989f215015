/** Structures of the Player interface blinkenlight: a light. This client does not use them. */
@NullMarked
package io.troupe.player.structures.blinkenlight;

import org.jspecify.annotations.NullMarked;
