/** Petri nets: building and composing them, firing, reachability, and PNML files. */
@NullMarked
package io.troupe.petri;

import org.jspecify.annotations.NullMarked;
