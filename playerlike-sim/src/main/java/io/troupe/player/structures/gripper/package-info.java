/** Structures of the Player interface gripper: a gripper. This client does not use them. */
@NullMarked
package io.troupe.player.structures.gripper;

import org.jspecify.annotations.NullMarked;
