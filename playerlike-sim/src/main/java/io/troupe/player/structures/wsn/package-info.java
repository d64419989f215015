/** Structures of the Player interface wsn: a wireless sensor network. This client does not use them. */
@NullMarked
package io.troupe.player.structures.wsn;

import org.jspecify.annotations.NullMarked;
