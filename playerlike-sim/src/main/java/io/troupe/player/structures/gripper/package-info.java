/** Structures of a gripper; no device here uses them. */
@NullMarked
package io.troupe.player.structures.gripper;

import org.jspecify.annotations.NullMarked;
