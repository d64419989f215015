/** Structures of a robot that moves in space; no device here uses them. */
@NullMarked
package io.troupe.player.structures.position3d;

import org.jspecify.annotations.NullMarked;
