/** Worlds to learn and to tune with: actions in, observations out, many worlds at once. */
@NullMarked
package io.troupe.sim.learn;

import org.jspecify.annotations.NullMarked;
