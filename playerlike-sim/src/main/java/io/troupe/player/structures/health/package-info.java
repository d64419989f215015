/** Structures of the Player interface health: the load of the server machine. This client does not use them. */
@NullMarked
package io.troupe.player.structures.health;

import org.jspecify.annotations.NullMarked;
