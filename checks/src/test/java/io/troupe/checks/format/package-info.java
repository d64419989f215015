/** Check of the format of all Java sources, run by both builds. */
@NullMarked
package io.troupe.checks.format;

import org.jspecify.annotations.NullMarked;
