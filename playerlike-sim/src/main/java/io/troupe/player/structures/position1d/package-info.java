/** Structures of a linear actuator; no device here uses them. */
@NullMarked
package io.troupe.player.structures.position1d;

import org.jspecify.annotations.NullMarked;
