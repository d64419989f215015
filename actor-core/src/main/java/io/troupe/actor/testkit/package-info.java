/** Crank a space by hand, move its clock, and see what its actors did. */
@NullMarked
package io.troupe.actor.testkit;

import org.jspecify.annotations.NullMarked;
