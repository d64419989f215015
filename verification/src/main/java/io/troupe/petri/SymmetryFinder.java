package io.troupe.petri;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.TreeSet;

/**
 * Looks for parts of a net that may be equal. What it finds are candidates, which {@link Symmetry} checks.
 *
 * <p>Places and transitions are coloured, first by tokens and priorities, and then by the colours of their neighbours
 * and the arcs to these, until no colour splits any more. Equal parts have equal colours. If one place is then given a
 * colour alone, other colours split because of it. The places of its part are then those that are apart from most
 * others of their old colour. If these are more than half of the places, as in a ring, they are no part.
 *
 * <p><b>Source.</b> B. D. McKay, Practical graph isomorphism (1981), for the refinement of colours.
 */
final class SymmetryFinder {
    private static final long MULTIPLIER = 0x9E3779B97F4A7C15L;

    /** The nodes are the places, then the transitions. */
    private final int places;

    private final int[][] neighbours;
    /** By node and neighbour: the kind and the weight of the arc. */
    private final long[][] arcs;

    private final int[] colours;
    /** By colour: how many nodes have it. */
    private final IntList sizes = new IntList();
    /** By colour: its nodes, and some that had it before. */
    private final List<IntList> nodes = new ArrayList<>();

    private final ArrayDeque<Integer> waiting = new ArrayDeque<>();
    /** The sum over the arcs to the colour that others are compared with. */
    private final long[] sums;

    SymmetryFinder(PetriNet net) {
        places = net.places().size();
        var size = places + net.transitions().size();
        var ends = new ArrayList<IntList>();
        var kinds = new ArrayList<List<Long>>();
        for (var i = 0; i < size; i++) {
            ends.add(new IntList(4));
            kinds.add(new ArrayList<>());
        }
        for (var t : net.transitions()) {
            var node = places + t.index();
            join(ends, kinds, node, t.inputs(), 1);
            join(ends, kinds, node, t.outputs(), 2);
            join(ends, kinds, node, t.inhibitors(), 3);
        }
        neighbours = ends.stream().map(IntList::toArray).toArray(int[][]::new);
        arcs = kinds.stream()
                .map(list -> list.stream().mapToLong(Long::longValue).toArray())
                .toArray(long[][]::new);
        colours = new int[size];
        sums = new long[size];
        var first = new TreeMap<List<Long>, IntList>(
                Comparator.comparing((List<Long> key) -> key.get(0)).thenComparing(key -> key.get(1)));
        net.places()
                .forEach(place -> first.computeIfAbsent(List.of(0L, place.tokens()), key -> new IntList(4))
                        .add(place.index()));
        net.transitions()
                .forEach(t -> first.computeIfAbsent(List.of(1L, (long) t.priority()), key -> new IntList(4))
                        .add(places + t.index()));
        first.values().forEach(this::newColour);
        refine(Integer.MAX_VALUE);
    }

    private static void join(List<IntList> ends, List<List<Long>> kinds, int node, List<Arc> arcs, int kind) {
        for (var arc : arcs) {
            var mixed = (arc.weight() * 4L + kind) * MULTIPLIER;
            mixed = (mixed ^ mixed >>> 29) * MULTIPLIER;
            ends.get(node).add(arc.place().index());
            kinds.get(node).add(mixed);
            ends.get(arc.place().index()).add(node);
            kinds.get(arc.place().index()).add(mixed);
        }
    }

    private int newColour(IntList members) {
        var colour = nodes.size();
        nodes.add(members);
        sizes.add(members.size());
        for (var node : members.toArray()) {
            colours[node] = colour;
        }
        waiting.add(colour);
        return colour;
    }

    /**
     * Splits colours until all nodes of one colour have the same arcs to each other colour. Gives up once there are
     * {@code mostColours}.
     */
    private boolean refine(int mostColours) {
        while (!waiting.isEmpty()) {
            var colour = waiting.remove();
            var touched = new IntList(16);
            for (var node : nodes.get(colour).toArray()) {
                if (colours[node] == colour) {
                    for (var i = 0; i < neighbours[node].length; i++) {
                        var other = neighbours[node][i];
                        if (sums[other] == 0) {
                            touched.add(other);
                        }
                        sums[other] += arcs[node][i];
                    }
                }
            }
            split(touched.toArray());
            if (nodes.size() > mostColours) {
                waiting.clear();
                return false;
            }
        }
        return true;
    }

    private void split(int[] touched) {
        var parts = new TreeMap<Integer, TreeMap<Long, IntList>>();
        for (var node : touched) {
            parts.computeIfAbsent(colours[node], colour -> new TreeMap<>())
                    .computeIfAbsent(sums[node], sum -> new IntList(4))
                    .add(node);
        }
        for (var node : touched) {
            sums[node] = 0;
        }
        parts.forEach((colour, bySum) -> {
            var rest = sizes.get(colour)
                    - bySum.values().stream().mapToInt(IntList::size).sum();
            if (rest == 0) {
                // all of them have an arc: the largest part keeps the colour
                var largest = bySum.entrySet().stream()
                        .max(Comparator.comparingInt(part -> part.getValue().size()))
                        .orElseThrow();
                bySum.remove(largest.getKey());
            }
            bySum.values().forEach(part -> {
                sizes.set(colour, sizes.get(colour) - part.size());
                newColour(part);
            });
        });
    }

    /** Groups of blocks that may be equal: the places of each, in corresponding order. */
    List<List<int[]>> groups() {
        var byColour = new LinkedHashMap<Integer, IntList>();
        for (var place = 0; place < places; place++) {
            byColour.computeIfAbsent(colours[place], colour -> new IntList(4)).add(place);
        }
        var found = new ArrayList<List<int[]>>();
        var covered = new boolean[places];
        for (var alike : byColour.values()) {
            if (alike.size() > 1 && !covered[alike.get(0)]) {
                blocks(alike.toArray(), covered).ifPresent(blocks -> {
                    found.add(blocks);
                    blocks.forEach(block -> Arrays.stream(block).forEach(place -> covered[place] = true));
                });
            }
        }
        return found;
    }

    /** The parts of some places of the same colour; empty if they overlap or have different sizes. */
    private Optional<List<int[]>> blocks(int[] alike, boolean[] covered) {
        var blocks = new ArrayList<int[]>();
        var seen = new HashSet<Integer>();
        for (var place : alike) {
            if (seen.contains(place)) {
                continue;
            }
            var block = block(place);
            if (block.length == 0 || !blocks.isEmpty() && block.length != blocks.getFirst().length) {
                return Optional.empty();
            }
            for (var each : block) {
                if (covered[each] || !seen.add(each)) {
                    return Optional.empty();
                }
            }
            blocks.add(block);
        }
        return blocks.size() > 1 ? Optional.of(blocks) : Optional.empty();
    }

    /** The places that change their colour with {@code place}; empty if these are too many. */
    private int[] block(int place) {
        var before = nodes.size();
        var old = colours.clone();
        var oldSizes = sizes.toArray();
        var alone = new IntList(4);
        alone.add(place);
        sizes.set(colours[place], sizes.get(colours[place]) - 1);
        newColour(alone);
        var isSmall = refine(before + neighbours.length / 2 + 1);
        var block = isSmall ? apart(before, old) : new int[0];
        System.arraycopy(old, 0, colours, 0, old.length);
        nodes.subList(before, nodes.size()).clear();
        while (sizes.size() > before) {
            sizes.removeLast();
        }
        for (var colour = 0; colour < before; colour++) {
            sizes.set(colour, oldSizes[colour]);
        }
        return 2 * block.length > places ? new int[0] : block;
    }

    /** The places that are no longer in the largest part of their old colour: by old colour, new colour, and number. */
    private int[] apart(int before, int[] old) {
        Map<Integer, TreeSet<Integer>> split = new TreeMap<>();
        for (var colour = before; colour < nodes.size(); colour++) {
            var first = old[nodes.get(colour).get(0)];
            split.computeIfAbsent(first, each -> new TreeSet<>(List.of(first))).add(colour);
        }
        var found = new IntList(16);
        for (var parts : split.values()) {
            // of two parts of the same size the one with the old colour
            var largest =
                    parts.stream().max(Comparator.comparingInt(sizes::get).thenComparing(Comparator.reverseOrder()));
            parts.remove(largest.orElseThrow());
            for (var part : parts) {
                Arrays.stream(nodes.get(part).toArray())
                        .filter(node -> node < places && colours[node] == part)
                        .distinct()
                        .sorted()
                        .forEach(found::add);
            }
        }
        return found.toArray();
    }
}
