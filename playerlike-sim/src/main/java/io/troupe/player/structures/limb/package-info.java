/** Structures of the Player interface limb: a robot arm. This client does not use them. */
@NullMarked
package io.troupe.player.structures.limb;

import org.jspecify.annotations.NullMarked;
