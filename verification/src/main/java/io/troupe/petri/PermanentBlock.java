package io.troupe.petri;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.List;

/**
 * Places that stay marked for ever once all of them are: components that wait for each other without end, whatever the
 * rest of the net goes on doing.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * @param places in the order of the net; no place of them alone is a block
 * @param markings how many reachable markings have all of them marked
 * @param nearest the one of these markings that is nearest to the initial one
 */
public record PermanentBlock(List<Place> places, int markings, ReachabilityGraph.State nearest) {
    public PermanentBlock {
        places = List.copyOf(places);
    }

    /**
     * The blocks of one place and of two, in the order of their places. A place that is merely never left, such as one
     * that says "finished", is one too. Of a graph that is not complete these are the ones not seen to be left so far.
     *
     * <p><b>Cost.</b> Time in proportion to (markings + edges) x places, and another pass over the markings for each block.
     */
    public static List<PermanentBlock> in(ReachabilityGraph graph) {
        var net = graph.net();
        var together = new BitSet[net.places().size()];
        var broken = new BitSet[net.places().size()];
        for (var place : net.places()) {
            together[place.index()] = new BitSet();
            broken[place.index()] = new BitSet();
        }
        var found = graph.found();
        var tokens = new int[net.places().size()];
        var emptied = new boolean[tokens.length];
        for (var id = 0; id < graph.size(); id++) {
            found.store.read(id, tokens);
            Arrays.fill(emptied, false);
            for (var edge = found.edgeStart.get(id); edge < found.edgeStart.get(id + 1); edge++) {
                markEmptied(net.transitions().get(found.edgeTransition.get(edge)), tokens, emptied);
            }
            var marked = marked(tokens);
            for (var place = marked.nextSetBit(0); place >= 0; place = marked.nextSetBit(place + 1)) {
                together[place].or(marked);
                if (emptied[place]) {
                    broken[place].or(marked);
                }
            }
        }
        return blocks(graph, together, broken);
    }

    private static BitSet marked(int[] tokens) {
        var marked = new BitSet(tokens.length);
        for (var place = 0; place < tokens.length; place++) {
            marked.set(place, tokens[place] > 0);
        }
        return marked;
    }

    private static void markEmptied(Transition transition, int[] tokens, boolean[] emptied) {
        for (var arc : transition.inputs()) {
            var place = arc.place();
            if (tokens[place.index()] == arc.weight()
                    && transition.outputs().stream()
                            .noneMatch(output -> output.place().equals(place))) {
                emptied[place.index()] = true;
            }
        }
    }

    private static List<PermanentBlock> blocks(ReachabilityGraph graph, BitSet[] together, BitSet[] broken) {
        var places = graph.net().places();
        var blocks = new ArrayList<PermanentBlock>();
        var alone = new BitSet();
        for (var place : places) {
            var at = place.index();
            alone.set(at, together[at].get(at) && !broken[at].get(at));
        }
        for (var first : places) {
            var p = first.index();
            if (alone.get(p)) {
                blocks.add(block(graph, List.of(first)));
                continue;
            }
            for (var q = together[p].nextSetBit(p + 1); q >= 0; q = together[p].nextSetBit(q + 1)) {
                if (!alone.get(q) && !broken[p].get(q) && !broken[q].get(p)) {
                    blocks.add(block(graph, List.of(first, places.get(q))));
                }
            }
        }
        return List.copyOf(blocks);
    }

    private static PermanentBlock block(ReachabilityGraph graph, List<Place> places) {
        var tokens = new int[graph.net().places().size()];
        var markings = 0;
        var nearest = -1;
        for (var id = 0; id < graph.size(); id++) {
            graph.found().store.read(id, tokens);
            if (places.stream().allMatch(place -> tokens[place.index()] > 0)) {
                nearest = markings == 0 ? id : nearest;
                markings++;
            }
        }
        return new PermanentBlock(places, markings, graph.state(nearest));
    }

    /** The places, how many markings have them, and how to get there. */
    @Override
    public String toString() {
        return places + " in " + markings + " markings, the nearest " + nearest + " after " + nearest.shortestTrace();
    }
}
