/** Structures of the Player interface log: data logging. This client does not use them. */
@NullMarked
package io.troupe.player.structures.log;

import org.jspecify.annotations.NullMarked;
