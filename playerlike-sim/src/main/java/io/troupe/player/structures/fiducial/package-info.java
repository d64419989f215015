/** Structures of the Player interface fiducial: a fiducial marker detector. This client does not use them. */
@NullMarked
package io.troupe.player.structures.fiducial;

import org.jspecify.annotations.NullMarked;
