/**
 * Worlds described in files ({@code .world}, {@code .cfg}). {@link io.troupe.sim.scenario.ScenarioReader} reads them
 * into records.
 */
@NullMarked
package io.troupe.sim.scenario;

import org.jspecify.annotations.NullMarked;
