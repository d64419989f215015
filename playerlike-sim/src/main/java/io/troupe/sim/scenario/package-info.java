/** A world described in a file ({@code .world}, {@code .cfg}), read into records. */
@NullMarked
package io.troupe.sim.scenario;

import org.jspecify.annotations.NullMarked;
