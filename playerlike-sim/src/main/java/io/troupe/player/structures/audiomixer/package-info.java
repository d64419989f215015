/** Structures of the Player interface audiomixer: an audio mixer. This client does not use them. */
@NullMarked
package io.troupe.player.structures.audiomixer;

import org.jspecify.annotations.NullMarked;
