/** Petri nets: building, composing and firing them, reachability, and PNML files. */
@NullMarked
package io.troupe.petri;

import org.jspecify.annotations.NullMarked;
