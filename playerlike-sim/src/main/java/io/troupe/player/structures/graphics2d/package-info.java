/** Structures of the Player interface graphics2d: 2D graphics. This client does not use them. */
@NullMarked
package io.troupe.player.structures.graphics2d;

import org.jspecify.annotations.NullMarked;
