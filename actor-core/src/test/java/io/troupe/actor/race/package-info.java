/** Random rounds of threads, spaces and actors that get into each other's way: what they do must add up. */
@NullMarked
package io.troupe.actor.race;

import org.jspecify.annotations.NullMarked;
