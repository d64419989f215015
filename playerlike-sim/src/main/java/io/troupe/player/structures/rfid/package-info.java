/** Structures of a reader of radio tags; no device here uses them. */
@NullMarked
package io.troupe.player.structures.rfid;

import org.jspecify.annotations.NullMarked;
