/** Structures of the Player interface pointcloud3d: 3D point clouds. This client does not use them. */
@NullMarked
package io.troupe.player.structures.pointcloud3d;

import org.jspecify.annotations.NullMarked;
