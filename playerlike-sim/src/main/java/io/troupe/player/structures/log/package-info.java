/** Structures of a recorder; no device here uses them. */
@NullMarked
package io.troupe.player.structures.log;

import org.jspecify.annotations.NullMarked;
