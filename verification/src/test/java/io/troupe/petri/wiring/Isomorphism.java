package io.troupe.petri.wiring;

import io.troupe.petri.Arc;
import io.troupe.petri.PetriNet;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.TreeMap;

/**
 * Decides whether two nets differ only in their names. Nodes are coloured by their tokens and then repeatedly by the
 * colours around them. Where several nodes have the same colour, one of them is given a separate colour, together with
 * each candidate of the other net in turn. The mapping found is verified by renaming.
 */
final class Isomorphism {
    private final PetriNet one;
    private final PetriNet other;

    private Isomorphism(PetriNet one, PetriNet other) {
        this.one = one;
        this.other = other;
    }

    /** The names of the second net by those of the first. */
    static Optional<Map<String, String>> find(PetriNet one, PetriNet other) {
        if (one.places().size() != other.places().size()
                || one.transitions().size() != other.transitions().size()
                || one.arcCount() != other.arcCount()) {
            return Optional.empty();
        }
        return new Isomorphism(one, other).match(start(one), start(other));
    }

    private Optional<Map<String, String>> match(Map<String, Integer> colours, Map<String, Integer> otherColours) {
        var a = new HashMap<>(colours);
        var b = new HashMap<>(otherColours);
        refine(a, b);
        var classes = byColour(a);
        var otherClasses = byColour(b);
        for (var colour : classes.keySet()) {
            if (!otherClasses.containsKey(colour)
                    || otherClasses.get(colour).size() != classes.get(colour).size()) {
                return Optional.empty();
            }
        }
        for (var colour : classes.keySet()) {
            var members = classes.get(colour);
            if (members.size() > 1) {
                a.put(members.get(0), -1);
                for (var candidate : otherClasses.get(colour)) {
                    var tried = new HashMap<>(b);
                    tried.put(candidate, -1);
                    var found = match(a, tried);
                    if (found.isPresent()) {
                        return found;
                    }
                }
                return Optional.empty();
            }
        }
        var names = new HashMap<String, String>();
        classes.forEach((colour, members) ->
                names.put(members.get(0), otherClasses.get(colour).get(0)));
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
        var before = 0;
        while (true) {
            var ids = new TreeMap<String, Integer>();
            var seenA = views(one, a);
            var seenB = views(other, b);
            seenA.values().forEach(view -> ids.put(view, 0));
            seenB.values().forEach(view -> ids.put(view, 0));
            var next = 0;
            for (var id : ids.entrySet()) {
                id.setValue(next++);
            }
            seenA.forEach((name, view) -> a.put(name, ids.get(view)));
            seenB.forEach((name, view) -> b.put(name, ids.get(view)));
            if (ids.size() == before) {
                return;
            }
            before = ids.size();
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
        var classes = new TreeMap<Integer, List<String>>();
        new TreeMap<>(colours)
                .forEach((name, colour) ->
                        classes.computeIfAbsent(colour, c -> new ArrayList<>()).add(name));
        return classes;
    }
}
