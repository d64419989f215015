package io.troupe.petri;

import java.util.BitSet;

/*
 * Breadth first over the markings of a net. What it leaves in its fields is what ReachabilityGraph and DeadlockSearch
 * tell.
 */
final class Exploration {
    final PetriNet net;
    MarkingStore store;
    /** Of every marking but the first: the marking it was first reached from, and by which transition. */
    final IntList parent = new IntList();

    final IntList parentTransition = new IntList();
    /** The edges of marking i are those from edgeStart(i) up to edgeStart(i + 1). */
    final IntList edgeStart = new IntList();

    final IntList edgeTransition = new IntList();
    final IntList edgeTarget = new IntList();
    final IntList dead = new IntList();
    final int[] most;
    final boolean[] fired;
    /** The markings of which successors are missing: left out at the limit, or not looked for. */
    final BitSet open = new BitSet();

    SearchEnd end = SearchEnd.COMPLETE;

    private final SearchLimits limits;
    private final Expansion expansion;
    private final int[] chosen;
    /** The places where a transition puts more than it takes, and how much more. */
    private final int[][] gains;

    private final int[][] gainWeights;
    private final int[] tokens;
    private long[][] packedChanges;
    private long[] successor;

    Exploration(PetriNet net, Expansion expansion, SearchLimits limits) {
        this.net = net;
        this.expansion = expansion;
        this.limits = limits;
        var transitions = net.transitions();
        chosen = new int[transitions.size()];
        gains = new int[transitions.size()][];
        gainWeights = new int[transitions.size()][];
        for (var t : transitions) {
            var growing = t.outputs().stream().filter(arc -> gain(t, arc) > 0).toList();
            gains[t.index()] =
                    growing.stream().mapToInt(arc -> arc.place().index()).toArray();
            gainWeights[t.index()] =
                    growing.stream().mapToInt(arc -> gain(t, arc)).toArray();
        }
        most = new int[net.places().size()];
        fired = new boolean[transitions.size()];
        tokens = net.initialMarking().toArray();
        store = new MarkingStore(tokens.length, 1);
        packedChanges = pack();
        successor = new long[store.words()];
    }

    void run() {
        for (var held : tokens) {
            widenTo(held);
        }
        store.add(store.pack(tokens));
        parent.add(-1);
        parentTransition.add(-1);
        var expanded = 0;
        while (expanded < store.size() && !limits.cancelled().getAsBoolean()) {
            expand(expanded++);
            if (expanded % limits.markingsPerReport() == 0) {
                limits.report().accept(new SearchProgress(store.size(), expanded, edgeTarget.size(), dead.size()));
            }
        }
        if (expanded < store.size()) {
            end = SearchEnd.CANCELLED;
        } else if (!open.isEmpty()) {
            end = SearchEnd.LIMIT;
        }
        for (var from = expanded; from < store.size(); from++) {
            open.set(from);
            read(from);
        }
        edgeStart.add(edgeTarget.size());
    }

    private void expand(int from) {
        read(from);
        var count = expansion.choose(tokens, chosen);
        for (var i = 0; i < count; i++) {
            var t = chosen[i];
            fired[t] = true;
            var to = reach(from, t);
            if (to >= 0) {
                edgeTransition.add(t);
                edgeTarget.add(to);
            } else {
                open.set(from);
            }
        }
        if (count == 0) {
            dead.add(from);
        }
    }

    private void read(int id) {
        store.read(id, tokens);
        for (var place = 0; place < tokens.length; place++) {
            most[place] = Math.max(most[place], tokens[place]);
        }
        edgeStart.add(edgeTarget.size());
    }

    /** The number of the marking after firing t, or -1 if it is new and there is no room for it. */
    private int reach(int from, int t) {
        var growing = gains[t];
        for (var i = 0; i < growing.length; i++) {
            var place = growing[i];
            widenTo(Tokens.sum(tokens[place], gainWeights[t][i], net.places().get(place)));
        }
        store.plus(from, packedChanges[t], successor);
        var known = store.find(successor);
        if (known >= 0 || store.size() == limits.maxMarkings()) {
            return known;
        }
        parent.add(from);
        parentTransition.add(t);
        return store.add(successor);
    }

    private void widenTo(int held) {
        if (held <= store.capacity()) {
            return;
        }
        while (held > store.capacity()) {
            store = store.widened();
        }
        packedChanges = pack();
        successor = new long[store.words()];
    }

    private long[][] pack() {
        return net.transitions().stream().map(store::change).toArray(long[][]::new);
    }

    private static int gain(Transition transition, Arc output) {
        var taken = transition.inputs().stream()
                .filter(arc -> arc.place().equals(output.place()))
                .findAny();
        return output.weight() - taken.map(Arc::weight).orElse(0);
    }
}
