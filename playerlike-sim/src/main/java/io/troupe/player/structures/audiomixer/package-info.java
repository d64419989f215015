/** Structures of a sound mixer; no device here uses them. */
@NullMarked
package io.troupe.player.structures.audiomixer;

import org.jspecify.annotations.NullMarked;
