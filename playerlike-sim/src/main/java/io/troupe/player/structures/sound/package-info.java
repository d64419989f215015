/** Structures of the Player interface sound: sound clips. This client does not use them. */
@NullMarked
package io.troupe.player.structures.sound;

import org.jspecify.annotations.NullMarked;
