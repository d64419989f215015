/** Structures of the Player interface map: a map. This client does not use them. */
@NullMarked
package io.troupe.player.structures.map;

import org.jspecify.annotations.NullMarked;
