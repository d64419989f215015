/** Motion and collisions of robots. Only this package may use jbox2d. */
@NullMarked
package io.troupe.sim.physics;

import org.jspecify.annotations.NullMarked;
