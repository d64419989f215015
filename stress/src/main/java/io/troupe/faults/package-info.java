/** Breaks hosts, links and processes of a bus at random, and checks what happened. */
@NullMarked
package io.troupe.faults;

import org.jspecify.annotations.NullMarked;
