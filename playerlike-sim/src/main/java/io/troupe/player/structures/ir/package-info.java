/** Structures of the Player interface ir: infrared sensors. This client does not use them. */
@NullMarked
package io.troupe.player.structures.ir;

import org.jspecify.annotations.NullMarked;
