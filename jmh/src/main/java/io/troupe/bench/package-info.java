/** What we measure, under which load, and against whom. */
@NullMarked
package io.troupe.bench;

import org.jspecify.annotations.NullMarked;
