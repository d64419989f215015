/** Structures of the Player interface camera: a camera. */
@NullMarked
package io.troupe.player.structures.camera;

import org.jspecify.annotations.NullMarked;
