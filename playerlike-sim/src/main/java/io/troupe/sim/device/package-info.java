/**
 * Sensors: sonar, ranger, blobfinder and position2d as functions of the poses in the world.
 * {@link io.troupe.sim.device.Scene} casts their rays.
 */
@NullMarked
package io.troupe.sim.device;

import org.jspecify.annotations.NullMarked;
