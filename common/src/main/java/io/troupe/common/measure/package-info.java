/** Tools for programs that measure: statistics, child JVMs, the used heap, a progress line. */
@NullMarked
package io.troupe.common.measure;

import org.jspecify.annotations.NullMarked;
