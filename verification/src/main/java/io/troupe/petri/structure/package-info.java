/**
 * Analysis of the structure of a Petri net, without visiting its markings: invariants, siphons, traps, state equation.
 */
@NullMarked
package io.troupe.petri.structure;

import org.jspecify.annotations.NullMarked;
