/** Structures of sound; no device here uses them. */
@NullMarked
package io.troupe.player.structures.audio;

import org.jspecify.annotations.NullMarked;
