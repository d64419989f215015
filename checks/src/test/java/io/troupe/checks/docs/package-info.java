/** Checks that the documentation agrees with what the build compiles and runs. */
@NullMarked
package io.troupe.checks.docs;

import org.jspecify.annotations.NullMarked;
