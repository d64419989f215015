/** Declared protocols and their wiring, the nets made from them, and the check for deadlocks. */
@NullMarked
package io.troupe.petri.wiring;

import org.jspecify.annotations.NullMarked;
