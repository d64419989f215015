/** Structures of bumpers; no device here uses them. */
@NullMarked
package io.troupe.player.structures.bumper;

import org.jspecify.annotations.NullMarked;
