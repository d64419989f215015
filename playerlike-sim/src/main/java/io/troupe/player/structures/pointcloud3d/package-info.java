/** Structures of a cloud of points; no device here uses them. */
@NullMarked
package io.troupe.player.structures.pointcloud3d;

import org.jspecify.annotations.NullMarked;
