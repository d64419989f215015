/** Structures of drawings in a plane; no device here uses them. */
@NullMarked
package io.troupe.player.structures.graphics2d;

import org.jspecify.annotations.NullMarked;
