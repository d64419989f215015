/** A world of robots that advances by fixed steps. */
@NullMarked
package io.troupe.sim;

import org.jspecify.annotations.NullMarked;
