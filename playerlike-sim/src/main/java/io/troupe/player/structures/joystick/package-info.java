/** Structures of a joystick; no device here uses them. */
@NullMarked
package io.troupe.player.structures.joystick;

import org.jspecify.annotations.NullMarked;
