/** Structures of the Player interface wifi: a wireless network. This client does not use them. */
@NullMarked
package io.troupe.player.structures.wifi;

import org.jspecify.annotations.NullMarked;
