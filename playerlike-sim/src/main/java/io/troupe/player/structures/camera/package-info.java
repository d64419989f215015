/** Structures of a camera; no device here uses them. */
@NullMarked
package io.troupe.player.structures.camera;

import org.jspecify.annotations.NullMarked;
