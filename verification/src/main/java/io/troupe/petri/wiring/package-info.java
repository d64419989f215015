/** From declared protocols and who calls whom to a net, and whether it can deadlock. */
@NullMarked
package io.troupe.petri.wiring;

import org.jspecify.annotations.NullMarked;
