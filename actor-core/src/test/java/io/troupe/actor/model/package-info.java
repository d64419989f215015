/** Actors against a simple sequential model: random programs run on both, and what can be seen must be the same. */
@NullMarked
package io.troupe.actor.model;

import org.jspecify.annotations.NullMarked;
