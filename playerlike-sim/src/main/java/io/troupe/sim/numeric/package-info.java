/** Arithmetic that gives the same bits on every machine, without allocation. */
@NullMarked
package io.troupe.sim.numeric;

import org.jspecify.annotations.NullMarked;
