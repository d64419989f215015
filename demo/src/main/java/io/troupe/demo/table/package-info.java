/** {@code troupe table}: subsumption tables as text grids and as state diagrams. */
@NullMarked
package io.troupe.demo.table;

import org.jspecify.annotations.NullMarked;
