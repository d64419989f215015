/** Clocks and timers; the only place that asks the machine for the time. */
@NullMarked
package io.troupe.actor.time;

import org.jspecify.annotations.NullMarked;
