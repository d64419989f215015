/** Structures of an array of actuators; no device here uses them. */
@NullMarked
package io.troupe.player.structures.actarray;

import org.jspecify.annotations.NullMarked;
