/**
 * Compares actors with a simple sequential model: random programs run on both, and their visible events must be equal.
 */
@NullMarked
package io.troupe.actor.model;

import org.jspecify.annotations.NullMarked;
