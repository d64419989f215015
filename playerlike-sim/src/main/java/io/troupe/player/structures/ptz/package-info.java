/** Structures of a camera that pans, tilts and zooms; no device here uses them. */
@NullMarked
package io.troupe.player.structures.ptz;

import org.jspecify.annotations.NullMarked;
