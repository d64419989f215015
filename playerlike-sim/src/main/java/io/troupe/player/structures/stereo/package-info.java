/** Structures of the Player interface stereo: a stereo camera. This client does not use them. */
@NullMarked
package io.troupe.player.structures.stereo;

import org.jspecify.annotations.NullMarked;
