/**
 * Runs for other tools: MCAP files for Foxglove and Lichtblick, and CSV tables for plots.
 *
 * <p>{@link io.troupe.view.tools.RunExport} reads a run and writes it in these formats.
 */
@NullMarked
package io.troupe.view.tools;

import org.jspecify.annotations.NullMarked;
