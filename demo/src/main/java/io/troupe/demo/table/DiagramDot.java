package io.troupe.demo.table;

import io.troupe.demo.table.Diagram.Node;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** Writes a diagram in the DOT format of Graphviz. */
final class DiagramDot {
    private DiagramDot() {}

    static String write(Diagram diagram) {
        var text = new StringBuilder("digraph table {\n");
        text.append("  label=").append(quoted(diagram.notes(), "\\l")).append(";\n");
        text.append("  labeljust=l; rankdir=")
                .append(diagram.hasBar() ? "LR" : "TB")
                .append(";\n");
        text.append("  node [shape=box, style=rounded, fontname=\"sans-serif\"];\n");
        text.append("  edge [fontname=\"sans-serif\"];\n");
        text.append("  start [shape=point];\n");
        for (Node node : diagram.nodes()) {
            List<String> lines = new ArrayList<>(List.of(node.heading()));
            lines.addAll(node.lines());
            text.append("  s").append(node.number()).append(" [label=").append(quoted(lines, "\\n"));
            text.append(node.ends() ? "" : ", style=\"rounded,dashed\"").append("];\n");
        }
        text.append("  start -> s1;\n");
        if (diagram.hasBar()) {
            text.append("  any [style=filled, label=")
                    .append(quoted(List.of(Diagram.BAR), "\\n"))
                    .append("];\n");
            diagram.nodes().forEach(node -> edge(text, "any", node));
        } else {
            diagram.arrows()
                    .forEach(arrow -> edge(
                            text,
                            "s" + diagram.nodes().get(arrow.from()).number(),
                            diagram.nodes().get(arrow.to())));
        }
        return text.append("}\n").toString();
    }

    private static void edge(StringBuilder text, String from, Node to) {
        text.append("  ").append(from).append(" -> s").append(to.number());
        text.append(" [label=").append(quoted(List.of(to.enters()), "\\n"));
        text.append(String.format(Locale.ROOT, ", color=\"#%06x\"];\n", to.colour()));
    }

    /** A quoted label; each line ends with the given Graphviz line break. */
    private static String quoted(List<String> lines, String lineBreak) {
        var label = new StringBuilder("\"");
        for (int index = 0; index < lines.size(); index++) {
            label.append(
                    lines.get(index).replace("&", "&amp;").replace("\\", "\\\\").replace("\"", "\\\""));
            label.append(index + 1 < lines.size() || lineBreak.equals("\\l") ? lineBreak : "");
        }
        return label.append('"').toString();
    }
}
