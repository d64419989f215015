/** Structures of the Player interface aio: analogue inputs and outputs. This client does not use them. */
@NullMarked
package io.troupe.player.structures.aio;

import org.jspecify.annotations.NullMarked;
