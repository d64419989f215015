/** {@code troupe draw}: draws a world as SVG. */
@NullMarked
package io.troupe.demo.draw;

import org.jspecify.annotations.NullMarked;
