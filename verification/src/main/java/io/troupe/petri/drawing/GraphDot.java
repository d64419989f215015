package io.troupe.petri.drawing;

import io.troupe.petri.ReachabilityGraph.State;

/** Writes one reachability graph as DOT: the markings are s0, s1, .. in the order of the graph. */
final class GraphDot {
    private final GraphContent content;
    private final StringBuilder dot = new StringBuilder();

    GraphDot(GraphContent content) {
        this.content = content;
    }

    String write() {
        var title = content.graph.toString();
        dot.append("digraph {\n  graph [label=").append(Dot.quoted(title)).append(", fontname=\"Helvetica\"];\n");
        dot.append("  node [fontname=\"Helvetica\", fontsize=11, margin=0.06, color=\"" + Palette.LINE + "\", ");
        dot.append(
                content.written
                        ? "shape=box, style=\"rounded,filled\", fillcolor=\"white\", height=0.3];\n"
                        : "shape=circle, style=filled, fillcolor=\"white\", label=\"\", width=0.12, fixedsize=true];\n");
        dot.append("  edge [fontname=\"Helvetica\", fontsize=10, arrowsize=0.6, color=\"");
        dot.append(content.written ? Palette.LINE : Palette.FAINT).append("\"];\n");
        content.states.forEach(this::state);
        content.edges.forEach(this::edge);
        return dot.append("}\n").toString();
    }

    private void state(State state) {
        dot.append("  s").append(state.index()).append(" [");
        if (content.written) {
            dot.append("label=")
                    .append(Dot.quoted(String.join(" ", GraphContent.words(state))))
                    .append(' ');
        }
        dot.append("tooltip=").append(Dot.quoted(state + content.remarks(state)));
        dot.append(content.isInitial(state) ? " peripheries=2" : "");
        dot.append(content.isDead(state) ? " fillcolor=\"" + Palette.DEAD_FILL + "\"" : "");
        dot.append(state.isOpen() ? " style=\"dashed,filled\"" : "");
        dot.append(content.isOnPath(state) ? " color=\"" + Palette.PATH + "\" penwidth=2" : "");
        dot.append("];\n");
    }

    private void edge(GraphContent.Edge edge) {
        dot.append("  s").append(edge.from()).append(" -> s").append(edge.to()).append(" [");
        dot.append(
                content.isNamed(edge) ? "label=" + Dot.quoted(edge.transition().name()) + " " : "");
        dot.append(edge.onPath() ? "color=\"" + Palette.PATH + "\" penwidth=2" : "");
        dot.append("];\n");
    }
}
