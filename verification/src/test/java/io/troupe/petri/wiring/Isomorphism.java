package io.troupe.petri.wiring;

import static java.util.stream.Collectors.groupingBy;
import static java.util.stream.Collectors.toList;

import io.troupe.petri.Arc;
import io.troupe.petri.PetriNet;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.TreeMap;
import java.util.TreeSet;

/**
 * Decides whether two nets differ only in their names. Nodes are coloured by their tokens and then repeatedly by the
 * colours around them. Where several nodes have the same colour, one of them is given a separate colour, together with
 * each candidate of the other net in turn. The mapping found is verified by renaming.
 */
record Isomorphism(PetriNet one, PetriNet other) {
    /** The names of the second net by those of the first. */
    static Optional<Map<String, String>> find(PetriNet one, PetriNet other) {
        return new Isomorphism(one, other).match(start(one), start(other));
    }

    private Optional<Map<String, String>> match(Map<String, Integer> colours, Map<String, Integer> otherColours) {
        var a = new HashMap<>(colours);
        var b = new HashMap<>(otherColours);
        refine(a, b);
        var classes = byColour(a);
        var otherClasses = byColour(b);
        var names = new HashMap<String, String>();
        for (var members : classes.entrySet()) {
            var candidates = otherClasses.getOrDefault(members.getKey(), List.of());
            if (candidates.size() != members.getValue().size()) {
                return Optional.empty();
            }
            names.put(members.getValue().getFirst(), candidates.getFirst());
        }
        for (var members : classes.entrySet()) {
            if (members.getValue().size() > 1) {
                a.put(members.getValue().getFirst(), -1);
                return otherClasses.get(members.getKey()).stream()
                        .flatMap(candidate -> {
                            var tried = new HashMap<>(b);
                            tried.put(candidate, -1);
                            return match(a, tried).stream();
                        })
                        .findFirst();
            }
        }
        var renamed = one.renamed(other.name(), name -> Objects.requireNonNull(names.get(name)));
        return renamed.sameStructureAs(other) ? Optional.of(names) : Optional.empty();
    }

    private static Map<String, Integer> start(PetriNet net) {
        var colours = new HashMap<String, Integer>();
        net.places().forEach(place -> colours.put(place.name(), 1000 + place.tokens()));
        net.transitions().forEach(t -> colours.put(t.name(), 2_000_000 + t.priority()));
        return colours;
    }

    private void refine(Map<String, Integer> a, Map<String, Integer> b) {
        var before = -1;
        while (true) {
            var viewsA = views(one, a);
            var viewsB = views(other, b);
            var all = new TreeSet<>(viewsA.values());
            all.addAll(viewsB.values());
            var numbered = List.copyOf(all);
            a.replaceAll((name, colour) -> numbered.indexOf(viewsA.get(name)));
            b.replaceAll((name, colour) -> numbered.indexOf(viewsB.get(name)));
            if (numbered.size() == before) {
                return;
            }
            before = numbered.size();
        }
    }

    /** The surroundings of a node: its colour and those of its neighbours, with directions and weights. */
    private static Map<String, String> views(PetriNet net, Map<String, Integer> colours) {
        var around = new HashMap<String, List<String>>();
        for (var transition : net.transitions()) {
            transition.inputs().forEach(arc -> see(around, arc, transition.name(), "in", colours));
            transition.outputs().forEach(arc -> see(around, arc, transition.name(), "out", colours));
        }
        var views = new HashMap<String, String>();
        colours.forEach((name, colour) -> {
            var seen = around.getOrDefault(name, List.of()).stream().sorted().toList();
            views.put(name, colour + " " + seen);
        });
        return views;
    }

    private static void see(
            Map<String, List<String>> around, Arc arc, String transition, String way, Map<String, Integer> colours) {
        var place = arc.place().name();
        var kind = way + "*" + arc.weight() + ":";
        around.computeIfAbsent(transition, name -> new ArrayList<>()).add(kind + colours.get(place));
        around.computeIfAbsent(place, name -> new ArrayList<>()).add(kind + colours.get(transition));
    }

    private static Map<Integer, List<String>> byColour(Map<String, Integer> colours) {
        return colours.keySet().stream().sorted().collect(groupingBy(colours::get, TreeMap::new, toList()));
    }
}
