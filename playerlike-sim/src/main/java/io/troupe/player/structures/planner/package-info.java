/** Structures of the Player interface planner: a path planner. This client does not use them. */
@NullMarked
package io.troupe.player.structures.planner;

import org.jspecify.annotations.NullMarked;
