/** Structures of the Player interface opaque: driver-defined messages. This client does not use them. */
@NullMarked
package io.troupe.player.structures.opaque;

import org.jspecify.annotations.NullMarked;
