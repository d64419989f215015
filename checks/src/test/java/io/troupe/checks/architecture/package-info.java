/** Architecture as tests: who may import whom, what is allowed where, and that the scan sees the classes at all. */
@NullMarked
package io.troupe.checks.architecture;

import org.jspecify.annotations.NullMarked;
