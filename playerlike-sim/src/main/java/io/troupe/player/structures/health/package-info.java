/** Structures of the load of a machine; no device here uses them. */
@NullMarked
package io.troupe.player.structures.health;

import org.jspecify.annotations.NullMarked;
