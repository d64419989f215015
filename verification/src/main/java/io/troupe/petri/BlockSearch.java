package io.troupe.petri;

import java.util.ArrayList;
import java.util.BitSet;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;

/**
 * Finds the minimal sets of places that stay marked for ever once all of them are marked.
 *
 * <p>From a marking with such a set the net reaches a terminal component, and every marking of that component marks the
 * set. So the candidates are the sets of places that are marked in every marking of some terminal component. They are
 * tested by size: one pass over all edges tests every candidate of one size, and most are dropped early in that pass.
 */
final class BlockSearch {
    private final ReachabilityGraph graph;
    private final Exploration found;
    private final long[] tokens;
    /** By transition: the places that it takes tokens from without returning any, and how many. */
    private final int[][] emptied;

    private final int[][] emptiedWeights;

    private static final class Candidate {
        private final BitSet places;
        private int markings;
        private int nearest;

        private Candidate(BitSet places) {
            this.places = places;
        }

        private boolean isMarked(long[] tokens) {
            for (var place = places.nextSetBit(0); place >= 0; place = places.nextSetBit(place + 1)) {
                if (tokens[place] == 0) {
                    return false;
                }
            }
            return true;
        }
    }

    BlockSearch(ReachabilityGraph graph) {
        this.graph = graph;
        found = graph.found();
        tokens = new long[graph.net().places().size()];
        var taking = graph.net().transitions().stream()
                .map(BlockSearch::withoutReturn)
                .toList();
        emptied = taking.stream()
                .map(arcs -> arcs.stream().mapToInt(arc -> arc.place().index()).toArray())
                .toArray(int[][]::new);
        emptiedWeights = taking.stream()
                .map(arcs -> arcs.stream().mapToInt(Arc::weight).toArray())
                .toArray(int[][]::new);
    }

    private static List<Arc> withoutReturn(Transition transition) {
        var given = transition.outputs().stream().map(Arc::place).toList();
        return transition.inputs().stream()
                .filter(arc -> !given.contains(arc.place()))
                .toList();
    }

    List<PermanentBlock> blocks(List<TerminalComponent> components, int maxPlaces) {
        var always = alwaysMarked(0, graph.size());
        var stages = new LinkedHashSet<BitSet>();
        for (var component : components) {
            var stays = alwaysMarked(component);
            stays.andNot(always);
            stages.add(stays);
        }
        var blocks = new ArrayList<Candidate>();
        for (var size = 1; size <= maxPlaces; size++) {
            var candidates = new LinkedHashMap<BitSet, Candidate>();
            for (var places : stages) {
                collect(places, 0, new BitSet(), size, blocks, candidates);
            }
            blocks.addAll(neverLeft(new ArrayList<>(candidates.values())));
        }
        return blocks.stream().map(this::block).toList();
    }

    private BitSet alwaysMarked(int from, int to) {
        var always = new BitSet();
        always.set(0, tokens.length);
        for (var id = from; id < to; id++) {
            retainMarked(always, id);
        }
        return always;
    }

    private BitSet alwaysMarked(TerminalComponent component) {
        var always = alwaysMarked(0, 0);
        for (var id : component.members()) {
            retainMarked(always, id);
        }
        return always;
    }

    private void retainMarked(BitSet always, int id) {
        found.store.read(id, tokens);
        for (var place = always.nextSetBit(0); place >= 0; place = always.nextSetBit(place + 1)) {
            always.set(place, tokens[place] > 0);
        }
    }

    /**
     * Collects all sets of {@code more} further places, starting at place {@code next}, that contain no smaller block.
     */
    private static void collect(
            BitSet places, int next, BitSet chosen, int more, List<Candidate> blocks, Map<BitSet, Candidate> result) {
        if (blocks.stream().anyMatch(block -> contains(chosen, block.places))) {
            return;
        }
        if (more == 0) {
            var set = (BitSet) chosen.clone();
            result.putIfAbsent(set, new Candidate(set));
            return;
        }
        for (var place = places.nextSetBit(next); place >= 0; place = places.nextSetBit(place + 1)) {
            chosen.set(place);
            collect(places, place + 1, chosen, more - 1, blocks, result);
            chosen.clear(place);
        }
    }

    private static boolean contains(BitSet set, BitSet part) {
        var rest = (BitSet) part.clone();
        rest.andNot(set);
        return rest.isEmpty();
    }

    private List<Candidate> neverLeft(List<Candidate> candidates) {
        var left = new BitSet();
        for (var id = 0; id < graph.size() && !candidates.isEmpty(); id++) {
            found.store.read(id, tokens);
            findLeft(id, left);
            candidates.removeIf(candidate -> candidate.isMarked(tokens) && candidate.places.intersects(left));
            for (var candidate : candidates) {
                if (candidate.isMarked(tokens)) {
                    candidate.nearest = candidate.markings++ == 0 ? id : candidate.nearest;
                }
            }
        }
        candidates.sort(Comparator.comparingInt(candidate -> candidate.nearest));
        return candidates;
    }

    /** Finds the places that some firing from marking {@code id} empties. */
    private void findLeft(int id, BitSet left) {
        left.clear();
        for (var edge = found.edgeStart(id); edge < found.edgeEnd(id); edge++) {
            var transition = found.edgeTransition.get(edge);
            for (var i = 0; i < emptied[transition].length; i++) {
                var place = emptied[transition][i];
                if (tokens[place] == emptiedWeights[transition][i]) {
                    left.set(place);
                }
            }
        }
    }

    private PermanentBlock block(Candidate candidate) {
        var places = candidate.places.stream()
                .mapToObj(place -> graph.net().places().get(place))
                .toList();
        return new PermanentBlock(places, candidate.markings, graph.state(candidate.nearest));
    }
}
