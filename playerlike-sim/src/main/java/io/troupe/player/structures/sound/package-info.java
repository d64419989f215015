/** Structures of sound clips; no device here uses them. */
@NullMarked
package io.troupe.player.structures.sound;

import org.jspecify.annotations.NullMarked;
