/**
 * What a world consists of: its obstacles, robots and their sensors as records, without the file they were read from.
 */
@NullMarked
package io.troupe.sim.model;

import org.jspecify.annotations.NullMarked;
