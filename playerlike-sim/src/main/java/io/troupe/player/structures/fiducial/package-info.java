/** Structures of the Player interface fiducial: a fiducial marker detector. */
@NullMarked
package io.troupe.player.structures.fiducial;

import org.jspecify.annotations.NullMarked;
