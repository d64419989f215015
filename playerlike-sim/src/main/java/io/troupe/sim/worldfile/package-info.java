/**
 * Worlds described in files ({@code .world}, {@code .cfg}). {@link io.troupe.sim.worldfile.ScenarioReader} reads them
 * into records.
 */
@NullMarked
package io.troupe.sim.worldfile;

import org.jspecify.annotations.NullMarked;
