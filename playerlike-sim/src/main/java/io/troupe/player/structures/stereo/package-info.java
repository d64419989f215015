/** Structures of a stereo camera; no device here uses them. */
@NullMarked
package io.troupe.player.structures.stereo;

import org.jspecify.annotations.NullMarked;
