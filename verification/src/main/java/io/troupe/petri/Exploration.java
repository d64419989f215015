package io.troupe.petri;

import java.util.Arrays;

/* Breadth first over the markings of a net. What it leaves in its fields is what ReachabilityGraph tells. */
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
    /** How many markings have a successor that was left out. */
    int open;

    private final int maxMarkings;
    private final int[][] inputs;
    private final int[][] inputWeights;
    /** The places where a transition puts more than it takes, and how much more. */
    private final int[][] gains;

    private final int[][] gainWeights;
    private final int[] priorities;
    private final boolean prioritised;
    private final int[] tokens;
    private long[][] packedChanges;
    private long[] successor;

    Exploration(PetriNet net, int maxMarkings) {
        this.net = net;
        this.maxMarkings = maxMarkings;
        var transitions = net.transitions();
        inputs = new int[transitions.size()][];
        inputWeights = new int[transitions.size()][];
        gains = new int[transitions.size()][];
        gainWeights = new int[transitions.size()][];
        for (var t : transitions) {
            inputs[t.index()] =
                    t.inputs().stream().mapToInt(arc -> arc.place().index()).toArray();
            inputWeights[t.index()] = t.inputs().stream().mapToInt(Arc::weight).toArray();
            var growing = t.outputs().stream().filter(arc -> gain(t, arc) > 0).toList();
            gains[t.index()] =
                    growing.stream().mapToInt(arc -> arc.place().index()).toArray();
            gainWeights[t.index()] =
                    growing.stream().mapToInt(arc -> gain(t, arc)).toArray();
        }
        priorities = transitions.stream().mapToInt(Transition::priority).toArray();
        prioritised = Arrays.stream(priorities).distinct().count() > 1;
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
        for (var from = 0; from < store.size(); from++) {
            expand(from);
        }
        edgeStart.add(edgeTarget.size());
    }

    private void expand(int from) {
        store.read(from, tokens);
        for (var place = 0; place < tokens.length; place++) {
            most[place] = Math.max(most[place], tokens[place]);
        }
        edgeStart.add(edgeTarget.size());
        var lowest = prioritised ? highestReady() : Integer.MIN_VALUE;
        var isDead = true;
        var leftOut = false;
        for (var t = 0; t < inputs.length; t++) {
            if (priorities[t] < lowest || !isReady(t)) {
                continue;
            }
            isDead = false;
            fired[t] = true;
            var to = reach(from, t);
            if (to >= 0) {
                edgeTransition.add(t);
                edgeTarget.add(to);
            } else {
                leftOut = true;
            }
        }
        if (isDead) {
            dead.add(from);
        }
        open += leftOut ? 1 : 0;
    }

    private boolean isReady(int t) {
        var places = inputs[t];
        for (var i = 0; i < places.length; i++) {
            if (tokens[places[i]] < inputWeights[t][i]) {
                return false;
            }
        }
        return true;
    }

    private int highestReady() {
        var highest = Integer.MIN_VALUE;
        for (var t = 0; t < inputs.length; t++) {
            if (priorities[t] > highest && isReady(t)) {
                highest = priorities[t];
            }
        }
        return highest;
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
        if (known >= 0 || store.size() == maxMarkings) {
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
