/** {@code troupe table}: tables of services as grids and as state diagrams. */
@NullMarked
package io.troupe.demo.table;

import org.jspecify.annotations.NullMarked;
