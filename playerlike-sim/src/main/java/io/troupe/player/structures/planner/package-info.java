/** Structures of a path planner; no device here uses them. */
@NullMarked
package io.troupe.player.structures.planner;

import org.jspecify.annotations.NullMarked;
