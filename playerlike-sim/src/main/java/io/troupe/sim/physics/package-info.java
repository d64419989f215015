/** The only room where jbox2d is allowed. */
@NullMarked
package io.troupe.sim.physics;

import org.jspecify.annotations.NullMarked;
