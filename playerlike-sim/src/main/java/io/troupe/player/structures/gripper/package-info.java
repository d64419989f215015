/** Structures of the Player interface gripper: a gripper. */
@NullMarked
package io.troupe.player.structures.gripper;

import org.jspecify.annotations.NullMarked;
