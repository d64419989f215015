/** Actors whose methods are messages, all on the one thread of their space. */
@NullMarked
package io.troupe.actor;

import org.jspecify.annotations.NullMarked;
