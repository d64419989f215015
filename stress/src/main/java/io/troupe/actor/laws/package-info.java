/** Runs the laws under jcstress, and fails when they did not run. */
@NullMarked
package io.troupe.actor.laws;

import org.jspecify.annotations.NullMarked;
