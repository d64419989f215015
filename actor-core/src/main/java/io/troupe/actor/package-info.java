/** Actors whose methods are messages, all on the single thread of their space. */
@NullMarked
package io.troupe.actor;

import org.jspecify.annotations.NullMarked;
