/** Designs that are declared from the guide, with what is found out about them. */
@NullMarked
package io.troupe.petri.examples;

import org.jspecify.annotations.NullMarked;
