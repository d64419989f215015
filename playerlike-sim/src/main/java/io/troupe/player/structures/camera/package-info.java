/** Structures of the Player interface camera: a camera. This client does not use them. */
@NullMarked
package io.troupe.player.structures.camera;

import org.jspecify.annotations.NullMarked;
