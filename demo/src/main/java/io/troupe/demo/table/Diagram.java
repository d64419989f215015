package io.troupe.demo.table;

import io.troupe.drawing.Dot;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/**
 * The content of a diagram of a table. Every state that can end leads to every other state, so the label of an arrow
 * depends only on its target.
 *
 * @param title window title and text for screen readers
 * @param notes lines below the picture
 */
record Diagram(String title, List<Node> nodes, List<String> notes) {
    /**
     * Up to this number of states all arrows are drawn. Of more, the arrows would cross too often: one bar represents
     * all other states.
     */
    private static final int MOST_WITH_ALL_ARROWS = 3;

    /** The text of the bar. */
    static final String BAR = "any other state in which a robot looks for colours";

    /**
     * A state in the diagram.
     *
     * @param enters label of arrows that lead to it
     * @param colour {@code 0x00RRGGBB}
     * @param ends whether arrows lead away from it
     */
    record Node(int number, String heading, List<String> lines, String enters, int colour, boolean ends) {}

    /** An arrow between two nodes, given by index. */
    record Arrow(int from, int to) {}

    Diagram {
        nodes = List.copyOf(nodes);
        notes = List.copyOf(notes);
    }

    /** The states, their services, and the colours that lead to them (Figure 8 of the paper). */
    static Diagram ofStates(SubsumptionTable table) {
        return new Diagram(
                "States of the " + table,
                table.states().stream()
                        .map(state -> node(
                                table,
                                state,
                                RobotGroups.lines(state, Service::name),
                                table.colourName(state.colour())))
                        .toList(),
                List.of());
    }

    /** The states, the order of the services in them, and the conditions that lead to them (Figure 12 of the paper). */
    static Diagram ofRules(SubsumptionTable table) {
        var rules = new SwitchingRules(table);
        return new Diagram(
                "Switching rules of the " + table,
                table.states().stream()
                        .map(state -> node(
                                table, state, RobotGroups.lines(state, rules::order), "A & " + rules.condition(state)))
                        .toList(),
                rules.notes());
    }

    private static Node node(SubsumptionTable table, State state, List<String> lines, String enters) {
        int priority = table.priority(state.colour());
        String heading = "state " + state.number() + (priority == 0 ? "" : ", priority " + priority)
                + (state.canEnd() ? "" : ", never ends");
        return new Node(state.number(), heading, lines, enters, state.colour(), state.canEnd());
    }

    boolean hasBar() {
        return nodes.size() > MOST_WITH_ALL_ARROWS;
    }

    /** All arrows between states. With a bar, the arrows to a state are drawn as one arrow from the bar. */
    List<Arrow> arrows() {
        List<Arrow> arrows = new ArrayList<>();
        for (int from = 0; from < nodes.size(); from++) {
            for (int to = 0; to < nodes.size(); to++) {
                if (from != to && nodes.get(from).ends) {
                    arrows.add(new Arrow(from, to));
                }
            }
        }
        return arrows;
    }

    /** The diagram in the DOT format of Graphviz, which lays it out. */
    String dot() {
        var text = new StringBuilder("digraph table {\n");
        text.append("  label=").append(Dot.leftAligned(notes)).append(";\n");
        text.append("  labeljust=l; rankdir=").append(hasBar() ? "LR" : "TB").append(";\n");
        text.append("  node [shape=box, style=rounded, fontname=\"sans-serif\"];\n");
        text.append("  edge [fontname=\"sans-serif\"];\n");
        text.append("  start [shape=point];\n");
        for (Node node : nodes) {
            var lines = new ArrayList<>(List.of(node.heading));
            lines.addAll(node.lines);
            text.append("  s").append(node.number).append(" [label=").append(Dot.quoted(String.join("\n", lines)));
            text.append(node.ends ? "" : ", style=\"rounded,dashed\"").append("];\n");
        }
        text.append("  start -> s1;\n");
        if (hasBar()) {
            text.append("  any [style=filled, label=").append(Dot.quoted(BAR)).append("];\n");
            nodes.forEach(node -> dotEdge(text, "any", node));
        } else {
            arrows().forEach(arrow -> dotEdge(text, "s" + nodes.get(arrow.from).number, nodes.get(arrow.to)));
        }
        return text.append("}\n").toString();
    }

    private static void dotEdge(StringBuilder text, String from, Node to) {
        text.append("  ").append(from).append(" -> s").append(to.number);
        text.append(" [label=").append(Dot.quoted(to.enters));
        text.append(String.format(Locale.ROOT, ", color=\"#%06x\"];\n", to.colour));
    }
}
