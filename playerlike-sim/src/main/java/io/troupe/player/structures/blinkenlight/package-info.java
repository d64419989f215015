/** Structures of a lamp; no device here uses them. */
@NullMarked
package io.troupe.player.structures.blinkenlight;

import org.jspecify.annotations.NullMarked;
