/** Runs the jcstress tests of actor-core ("laws"), and fails if they did not run. */
@NullMarked
package io.troupe.actor.laws;

import org.jspecify.annotations.NullMarked;
