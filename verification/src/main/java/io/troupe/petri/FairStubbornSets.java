package io.troupe.petri;

import java.util.ArrayList;
import java.util.List;

/**
 * Stubborn sets that are enlarged where a reduced search would follow a loop for ever and ignore transitions that are
 * ready outside it (the ignoring problem).
 */
final class FairStubbornSets implements Expansion {
    /** The transitions of a loop, and the tokens on its places at which the search also follows other transitions. */
    private record Loop(boolean[] transitions, int[] places, int[] tokens) {
        boolean passes(int[] now) {
            for (var i = 0; i < places.length; i++) {
                if (now[places[i]] != tokens[i]) {
                    return false;
                }
            }
            return true;
        }
    }

    private final PetriNet net;
    private final StubbornSets sets;
    private final List<Loop> loops = new ArrayList<>();

    FairStubbornSets(PetriNet net) {
        this.net = net;
        sets = new StubbornSets(net);
    }

    /**
     * Makes the search follow other transitions too at each marking that equals the entry of {@code component} on all
     * places next to the component's firings.
     */
    void open(TerminalComponent component) {
        var looping = new boolean[net.transitions().size()];
        var around = new boolean[net.places().size()];
        for (var t : net.transitions()) {
            if (component.fires(t)) {
                looping[t.index()] = true;
                t.inputs().forEach(arc -> around[arc.place().index()] = true);
                t.outputs().forEach(arc -> around[arc.place().index()] = true);
            }
        }
        var places = net.places().stream()
                .mapToInt(Place::index)
                .filter(place -> around[place])
                .toArray();
        var entry = component.entry().marking().toArray();
        var tokens = new int[places.length];
        for (var i = 0; i < places.length; i++) {
            tokens[i] = entry[places[i]];
        }
        loops.add(new Loop(looping, places, tokens));
    }

    @Override
    public int choose(int[] tokens, int[] chosen) {
        var count = sets.choose(tokens, chosen);
        for (var loop : loops) {
            if (loop.passes(tokens)) {
                count = sets.widen(tokens, chosen, count, loop.transitions());
            }
        }
        return count;
    }
}
