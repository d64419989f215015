/** Decides whether a net can deadlock: reductions, searches for a counterexample, and proofs. */
@NullMarked
package io.troupe.petri.deadlock;

import org.jspecify.annotations.NullMarked;
