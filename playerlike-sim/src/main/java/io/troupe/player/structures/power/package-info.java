/** Structures of a battery; no device here uses them. */
@NullMarked
package io.troupe.player.structures.power;

import org.jspecify.annotations.NullMarked;
