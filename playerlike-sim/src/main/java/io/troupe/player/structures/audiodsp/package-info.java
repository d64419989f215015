/** Structures of a sound processor; no device here uses them. */
@NullMarked
package io.troupe.player.structures.audiodsp;

import org.jspecify.annotations.NullMarked;
