/** Structures of a satellite receiver; no device here uses them. */
@NullMarked
package io.troupe.player.structures.gps;

import org.jspecify.annotations.NullMarked;
