/** Checks of the architecture: allowed dependencies, libraries and habits, and that the classes are scanned at all. */
@NullMarked
package io.troupe.checks.architecture;

import org.jspecify.annotations.NullMarked;
