/** Structures of the Player interface audiodsp: audio signal processing. This client does not use them. */
@NullMarked
package io.troupe.player.structures.audiodsp;

import org.jspecify.annotations.NullMarked;
