/** The command line {@code troupe}. */
@NullMarked
package io.troupe.demo;

import org.jspecify.annotations.NullMarked;
