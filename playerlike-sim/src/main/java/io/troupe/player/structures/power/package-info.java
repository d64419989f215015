/** Structures of the Player interface power: a battery. This client does not use them. */
@NullMarked
package io.troupe.player.structures.power;

import org.jspecify.annotations.NullMarked;
