/** Structures of a network of sensor nodes; no device here uses them. */
@NullMarked
package io.troupe.player.structures.wsn;

import org.jspecify.annotations.NullMarked;
