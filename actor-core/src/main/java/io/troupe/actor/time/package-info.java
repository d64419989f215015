/** Clocks and timers; the only package that reads the machine's time. */
@NullMarked
package io.troupe.actor.time;

import org.jspecify.annotations.NullMarked;
