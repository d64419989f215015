/** Soak test: many messages from many threads for a while; none is lost, out of order or retained. */
@NullMarked
package io.troupe.actor.soak;

import org.jspecify.annotations.NullMarked;
