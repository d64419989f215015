/** The only room where jbox2d is allowed: how robots move and what they bump into. */
@NullMarked
package io.troupe.sim.physics;

import org.jspecify.annotations.NullMarked;
