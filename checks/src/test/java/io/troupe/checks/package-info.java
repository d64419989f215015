/** The repository as the checks use it: its location, its modules and its sources. */
@NullMarked
package io.troupe.checks;

import org.jspecify.annotations.NullMarked;
