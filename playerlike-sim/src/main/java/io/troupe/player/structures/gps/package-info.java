/** Structures of the Player interface gps: a GPS receiver. This client does not use them. */
@NullMarked
package io.troupe.player.structures.gps;

import org.jspecify.annotations.NullMarked;
