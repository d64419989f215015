/** The repository as the checks see it: where it lies and which modules it has. */
@NullMarked
package io.troupe.checks;

import org.jspecify.annotations.NullMarked;
