/**
 * What the structure of a Petri net proves without visiting its markings: invariants, siphons, traps, state equation.
 */
@NullMarked
package io.troupe.petri.structure;

import org.jspecify.annotations.NullMarked;
