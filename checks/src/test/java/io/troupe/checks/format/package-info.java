/** One look for all Java sources, checked by both builds. */
@NullMarked
package io.troupe.checks.format;

import org.jspecify.annotations.NullMarked;
