/** Structures of the Player interface ptz: a pan-tilt-zoom camera. This client does not use them. */
@NullMarked
package io.troupe.player.structures.ptz;

import org.jspecify.annotations.NullMarked;
