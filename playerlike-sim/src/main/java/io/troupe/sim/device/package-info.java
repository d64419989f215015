/** Sonar, blobfinder and position2d: functions of where everything is. */
@NullMarked
package io.troupe.sim.device;

import org.jspecify.annotations.NullMarked;
