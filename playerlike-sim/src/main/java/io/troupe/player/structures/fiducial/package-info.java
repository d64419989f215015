/** Structures of a finder of marks; no device here uses them. */
@NullMarked
package io.troupe.player.structures.fiducial;

import org.jspecify.annotations.NullMarked;
