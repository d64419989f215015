/** Pictures as text: {@link io.troupe.common.svg.Svg} for browsers, {@link io.troupe.common.svg.Dot} for Graphviz. */
@NullMarked
package io.troupe.common.svg;

import org.jspecify.annotations.NullMarked;
