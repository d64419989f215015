package io.troupe.petri;

import java.util.ArrayList;
import java.util.List;

/*
 * Stubborn sets, made larger where a search that followed only them would go round in a loop and never fire what is
 * ready beside it.
 */
final class FairStubbornSets implements Expansion {
    /** Transitions in which a search went round, and the tokens around them where the others get their turn. */
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
     * From now on, others get their turn where the marking around the firings of {@code component} is as at its entry.
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
