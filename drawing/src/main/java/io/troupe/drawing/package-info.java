/** Pictures as text: {@link io.troupe.drawing.Svg} for browsers, {@link io.troupe.drawing.Dot} for Graphviz. */
@NullMarked
package io.troupe.drawing;

import org.jspecify.annotations.NullMarked;
