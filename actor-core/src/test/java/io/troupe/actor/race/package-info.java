/** Random rounds of threads, spaces and actors that interfere with each other: counts of what they do must match. */
@NullMarked
package io.troupe.actor.race;

import org.jspecify.annotations.NullMarked;
