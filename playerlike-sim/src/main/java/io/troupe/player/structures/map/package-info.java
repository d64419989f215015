/** Structures of a map; no device here uses them. */
@NullMarked
package io.troupe.player.structures.map;

import org.jspecify.annotations.NullMarked;
