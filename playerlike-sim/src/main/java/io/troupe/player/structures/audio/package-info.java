/** Structures of the Player interface audio: audio. This client does not use them. */
@NullMarked
package io.troupe.player.structures.audio;

import org.jspecify.annotations.NullMarked;
