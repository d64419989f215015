package io.troupe.petri.drawing;

import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.Set;

/** Writes one net as DOT: places are p0, p1, .., transitions t0, t1, .. in the order of the net. */
final class NetDot {
    private static final int MOST_DOTS = 4;

    private final PetriNet net;
    private final Marking marking;
    private final Set<Transition> highlighted;
    private final StringBuilder dot = new StringBuilder();

    NetDot(PetriNet net, Marking marking, Set<Transition> highlighted) {
        this.net = net;
        this.marking = marking;
        this.highlighted = highlighted;
    }

    String write() {
        dot.append("digraph {\n");
        dot.append("  graph [rankdir=LR, label=").append(Dot.quoted(net.name())).append(", fontname=\"Helvetica\"];\n");
        dot.append("  node [fontname=\"Helvetica\", fontsize=11, margin=0.04, color=\"" + Palette.LINE + "\"];\n");
        dot.append("  edge [fontname=\"Helvetica\", fontsize=11, arrowsize=0.7, color=\"" + Palette.LINE + "\"];\n");
        net.places().forEach(this::place);
        net.transitions().forEach(this::transition);
        net.transitions().forEach(this::arcs);
        return dot.append("}\n").toString();
    }

    private void place(Place place) {
        var tokens = marking.tokens(place);
        var held = tokens <= MOST_DOTS ? "●".repeat(tokens) : String.valueOf(tokens);
        dot.append("  p").append(place.index()).append(" [shape=circle, label=");
        dot.append(Dot.quoted(place.name() + (tokens == 0 ? "" : "\n" + held)));
        dot.append(tokens == 0 ? "" : ", style=filled, fillcolor=\"" + Palette.MARKED_FILL + "\"");
        dot.append("];\n");
    }

    private void transition(Transition transition) {
        var priority = transition.priority() == 0 ? "" : "\npriority " + transition.priority();
        dot.append("  t").append(transition.index()).append(" [shape=box, height=0.3, width=0.3, label=");
        dot.append(Dot.quoted(transition.name() + priority));
        dot.append(", style=filled, fillcolor=\"");
        dot.append(
                highlighted.contains(transition)
                        ? Palette.PATH_FILL + "\", color=\"" + Palette.PATH + "\", penwidth=2"
                        : "#eeeeee\"");
        dot.append("];\n");
    }

    private void arcs(Transition transition) {
        var node = "t" + transition.index();
        var coloured = highlighted.contains(transition);
        transition.inputs().forEach(arc -> arc("p" + arc.place().index(), node, arc.weight(), coloured));
        transition.outputs().forEach(arc -> arc(node, "p" + arc.place().index(), arc.weight(), coloured));
    }

    private void arc(String from, String to, int weight, boolean coloured) {
        dot.append("  ").append(from).append(" -> ").append(to).append(" [");
        dot.append(weight == 1 ? "" : "label=\"" + weight + "\" ");
        dot.append(coloured ? "color=\"" + Palette.PATH + "\" penwidth=2" : "");
        dot.append("];\n");
    }
}
