/** Structures of the Player interface joystick: a joystick. This client does not use them. */
@NullMarked
package io.troupe.player.structures.joystick;

import org.jspecify.annotations.NullMarked;
