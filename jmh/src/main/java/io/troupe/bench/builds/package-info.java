/** Compares an older build of Troupe with this one, and reports what became slower. */
@NullMarked
package io.troupe.bench.builds;

import org.jspecify.annotations.NullMarked;
