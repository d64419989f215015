/** Structures of the Player interface graphics3d: 3D graphics. This client does not use them. */
@NullMarked
package io.troupe.player.structures.graphics3d;

import org.jspecify.annotations.NullMarked;
