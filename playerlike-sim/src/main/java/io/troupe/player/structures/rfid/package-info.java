/** Structures of the Player interface rfid: an RFID reader. This client does not use them. */
@NullMarked
package io.troupe.player.structures.rfid;

import org.jspecify.annotations.NullMarked;
