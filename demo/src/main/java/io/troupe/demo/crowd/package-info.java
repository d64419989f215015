/** Crowds: teams of any number of robots, and {@code troupe crowd}, which measures their cost. */
@NullMarked
package io.troupe.demo.crowd;

import org.jspecify.annotations.NullMarked;
