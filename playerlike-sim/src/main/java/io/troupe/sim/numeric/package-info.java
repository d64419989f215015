/** Arithmetic that gives the same bits on every machine, and no garbage. */
@NullMarked
package io.troupe.sim.numeric;

import org.jspecify.annotations.NullMarked;
