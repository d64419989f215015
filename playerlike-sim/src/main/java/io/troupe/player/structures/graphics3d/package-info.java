/** Structures of drawings in space; no device here uses them. */
@NullMarked
package io.troupe.player.structures.graphics3d;

import org.jspecify.annotations.NullMarked;
