/** Drawings of nets and of small reachability graphs, as DOT for Graphviz and as SVG. */
@NullMarked
package io.troupe.petri.drawing;

import org.jspecify.annotations.NullMarked;
