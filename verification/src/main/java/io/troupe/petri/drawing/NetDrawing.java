package io.troupe.petri.drawing;

import static java.util.Objects.requireNonNull;

import io.troupe.drawing.Dot;
import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.Collection;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/**
 * A drawing of a net: places are circles with their tokens, transitions are boxes; weights of arcs and priorities are
 * shown where they are not 1 and 0.
 *
 * <p><b>Role.</b> {@code NetDrawing.of(net).marked(dead).highlighting(trace).svg()}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> The same net, marking and firings give the same bytes.
 *
 * <p><b>Errors.</b> A marking or a transition of another net throws {@link IllegalArgumentException}.
 */
public final class NetDrawing {
    /** The most places and transitions of a net that {@link #svg} draws; the layout of thousands takes minutes. */
    public static final int MOST_SVG_NODES = 400;

    /** The most arcs of a net that {@link #svg} draws. */
    public static final int MOST_SVG_ARCS = 1500;

    private final PetriNet net;
    private final Marking marking;
    private final Set<Transition> highlighted;
    private final Map<String, List<Place>> components;

    private NetDrawing(
            PetriNet net, Marking marking, Set<Transition> highlighted, Map<String, List<Place>> components) {
        this.net = net;
        this.marking = marking;
        this.highlighted = highlighted;
        this.components = components;
    }

    /** The net in its initial marking. */
    public static NetDrawing of(PetriNet net) {
        return new NetDrawing(requireNonNull(net, "net"), net.initialMarking(), Set.of(), Map.of());
    }

    /** The same drawing in another marking. */
    public NetDrawing marked(Marking other) {
        for (var place : other.marked()) {
            require(isOfNet(place), "place " + place + " of marking " + other + " is not of net ");
        }
        net.places().forEach(other::tokens);
        return new NetDrawing(net, other, highlighted, components);
    }

    private boolean isOfNet(Place place) {
        return place.index() < net.places().size()
                && net.places().get(place.index()).equals(place);
    }

    /**
     * The same drawing with only these transitions and their arcs coloured; a trace may name a transition many times.
     */
    public NetDrawing highlighting(Collection<Transition> firings) {
        var distinct = new LinkedHashSet<Transition>(firings); // in order, so that an error names the first wrong one
        var all = net.transitions();
        for (var firing : distinct) {
            require(
                    firing.index() < all.size() && all.get(firing.index()).equals(firing),
                    "transition " + firing + " is not of net ");
        }
        return new NetDrawing(net, marking, Set.copyOf(distinct), components);
    }

    /**
     * The same drawing with a separate fill colour for the places of each component, and a legend with the components'
     * names. A transition gets this fill if all places around it belong to one component; all others stay grey.
     *
     * @param places by the name of the component, in the order of the legend; only {@link #svg} shows them
     */
    public NetDrawing tinting(Map<String, List<Place>> places) {
        var copy = new LinkedHashMap<String, List<Place>>();
        places.forEach((component, its) -> {
            for (var place : its) {
                require(isOfNet(place), "place " + place + " of component " + component + " is not of net ");
            }
            copy.put(component, List.copyOf(its));
        });
        return new NetDrawing(net, marking, highlighted, Collections.unmodifiableMap(copy));
    }

    /** DOT, which Graphviz lays out. */
    public String dot() {
        return new DotWriter(net, marking, highlighted).write();
    }

    /**
     * A complete SVG file, laid out from left to right.
     *
     * @throws IllegalArgumentException if the net has more than {@link #MOST_SVG_NODES} places and transitions or
     *     {@link #MOST_SVG_ARCS} arcs
     * @throws IllegalStateException if ELK is not on the class path; the message names the artifacts
     */
    public String svg() {
        requireAtMost(net.places().size() + net.transitions().size(), MOST_SVG_NODES, "places and transitions");
        requireAtMost(net.arcCount(), MOST_SVG_ARCS, "arcs");
        return Elk.drawn(() -> new NetSvg(net, marking, highlighted, components).write());
    }

    private void requireAtMost(int count, int most, String what) {
        if (count > most) {
            throw new IllegalArgumentException("net " + net.name() + " has " + count + " " + what
                    + ", expected at most " + most + " for an SVG drawing; dot() has no limit");
        }
    }

    private void require(boolean condition, String message) {
        if (!condition) {
            throw new IllegalArgumentException(message + net.name());
        }
    }

    /** Writes one net as DOT: places are p0, p1, .., transitions t0, t1, .. in the order of the net. */
    private static final class DotWriter {
        private static final int MOST_DOTS = 4;

        private final PetriNet net;
        private final Marking marking;
        private final Set<Transition> highlighted;
        private final StringBuilder dot = new StringBuilder();

        DotWriter(PetriNet net, Marking marking, Set<Transition> highlighted) {
            this.net = net;
            this.marking = marking;
            this.highlighted = highlighted;
        }

        String write() {
            dot.append("digraph {\n");
            dot.append("  graph [rankdir=LR, label=")
                    .append(Dot.quoted(net.name()))
                    .append(", fontname=\"Helvetica\"];\n");
            dot.append("  node [fontname=\"Helvetica\", fontsize=11, margin=0.04, color=\"" + Palette.LINE + "\"];\n");
            dot.append(
                    "  edge [fontname=\"Helvetica\", fontsize=11, arrowsize=0.7, color=\"" + Palette.LINE + "\"];\n");
            net.places().forEach(this::place);
            net.transitions().forEach(this::transition);
            net.transitions().forEach(this::arcs);
            return dot.append("}\n").toString();
        }

        private void place(Place place) {
            var tokens = marking.tokens(place);
            var held = tokens <= MOST_DOTS ? "●".repeat((int) tokens) : String.valueOf(tokens);
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
            transition.inputs().forEach(arc -> arc("p" + arc.place().index(), node, arc.weight(), coloured, ""));
            transition.outputs().forEach(arc -> arc(node, "p" + arc.place().index(), arc.weight(), coloured, ""));
            transition
                    .inhibitors()
                    .forEach(arc -> arc("p" + arc.place().index(), node, arc.weight(), coloured, "arrowhead=odot "));
        }

        private void arc(String from, String to, int weight, boolean coloured, String head) {
            dot.append("  ").append(from).append(" -> ").append(to).append(" [").append(head);
            dot.append(weight == 1 ? "" : "label=\"" + weight + "\" ");
            dot.append(coloured ? "color=\"" + Palette.PATH + "\" penwidth=2" : "");
            dot.append("];\n");
        }
    }
}
