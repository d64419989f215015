package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.ArrayList;
import java.util.List;

/**
 * Finds the transitions that are live, that is: can fire again after any firing sequence, without visiting all
 * markings.
 *
 * <p>The reduced graph of {@link DeadlockSearch} may follow a loop for ever and ignore transitions that are ready
 * outside it. This search enlarges the stubborn sets of such loops until none is left. Then a transition that can fire
 * after some marking of the full graph can fire after a marking of the reduced graph, and vice versa. So the terminal
 * components of both graphs lose the same transitions.
 *
 * <p><b>Role.</b> Made by {@link #run}; the faster way to the answers of {@link Liveness} about transitions.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> As for {@link DeadlockSearch}, once more for each round in which loops are enlarged. The numbers of
 * markings of components that loop independently multiply, as in the full graph.
 *
 * <p><b>Source.</b> A. Valmari, Stubborn sets for reduced state space generation, 1989, and Stop it, and be stubborn!,
 * 2015, on the ignoring problem.
 */
public final class ProgressSearch {
    private static final int MAX_ROUNDS = 100;

    private final ReachabilityGraph visited;
    private final SearchEnd end;
    private final List<Loss> losses;

    private ProgressSearch(ReachabilityGraph visited, SearchEnd end, List<Loss> losses) {
        this.visited = visited;
        this.end = end;
        this.losses = losses;
    }

    /**
     * A marking after which some transitions never fire again, while every other transition can always fire again.
     *
     * @param marking the first visited marking of this kind
     * @param trace a firing sequence from the initial marking; not always a shortest one, unless the marking is dead
     * @param lost the transitions that never fire again: all if the marking is dead
     */
    public record Loss(Marking marking, List<Transition> trace, List<Transition> lost) {
        public Loss {
            requireNonNull(marking, "marking");
            trace = List.copyOf(trace);
            lost = List.copyOf(lost);
        }
    }

    /**
     * Searches within {@code limits}, which apply to each round in which loops are enlarged.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static ProgressSearch run(PetriNet net, SearchLimits limits) {
        var sets = new FairStubbornSets(net);
        var game = new TokenGame(net);
        var graph = ReachabilityGraph.explore(net, sets, limits);
        for (var round = 1; graph.isComplete() && round < MAX_ROUNDS; round++) {
            var components = Liveness.of(graph).terminalComponents();
            var closed = components.stream()
                    .filter(component -> ignoresOthers(component, net, game))
                    .toList();
            if (closed.isEmpty()) {
                return new ProgressSearch(graph, SearchEnd.COMPLETE, losses(components));
            }
            closed.forEach(sets::open);
            graph = ReachabilityGraph.explore(net, sets, limits);
        }
        return new ProgressSearch(graph, graph.isComplete() ? SearchEnd.LIMIT : graph.end(), List.of());
    }

    /**
     * A transition that is ready outside a loop of stubborn sets stays ready in the whole loop, so one marking is
     * enough.
     */
    private static boolean ignoresOthers(TerminalComponent component, PetriNet net, TokenGame game) {
        var ready = new int[net.transitions().size()];
        game.moveTo(component.entry().marking().toArray());
        var count = game.enabled(ready);
        for (var i = 0; i < count; i++) {
            if (!component.fires(net.transitions().get(ready[i]))) {
                return true;
            }
        }
        return false;
    }

    private static List<Loss> losses(List<TerminalComponent> components) {
        return components.stream()
                .filter(component -> !component.neverFired().isEmpty())
                .map(component -> new Loss(
                        component.entry().marking(), component.entry().shortestTrace(), component.neverFired()))
                .toList();
    }

    public PetriNet net() {
        return visited.net();
    }

    /** All ways in which the net can lose transitions for ever; empty if the search ended early. */
    public List<Loss> losses() {
        return losses;
    }

    /** Whether {@code transition} is live: it can fire again after any firing sequence. */
    public Verdict live(Transition transition) {
        net().transition(transition.name());
        if (end != SearchEnd.COMPLETE) {
            return Verdict.UNKNOWN;
        }
        return losses.stream().anyMatch(loss -> loss.lost().contains(transition)) ? Verdict.NO : Verdict.YES;
    }

    /** Why the search ended; {@link SearchEnd#LIMIT} also if there are too many loops. */
    public SearchEnd end() {
        return end;
    }

    /** How many markings were visited. */
    public int visitedMarkings() {
        return visited.size();
    }

    /** How many firings were followed. */
    public int visitedEdges() {
        return visited.edgeCount();
    }

    /** The number of visited markings, and the result. */
    @Override
    public String toString() {
        var known = switch (end) {
            case COMPLETE ->
                losses.isEmpty() ? "all transitions are live" : losses.size() + " ways to lose transitions";
            case LIMIT -> "stopped at the limit";
            case MEMORY -> "out of memory";
            case CANCELLED -> "cancelled";
        };
        return net().name() + ": " + visitedMarkings() + " markings visited, " + known;
    }

    /**
     * Stubborn sets that are enlarged where a reduced search would follow a loop for ever and ignore transitions that
     * are ready outside it (the ignoring problem).
     */
    private static final class FairStubbornSets implements Chooser {
        /**
         * The transitions of a loop, and the tokens on its places at which the search also follows other transitions.
         */
        private record Loop(boolean[] transitions, int[] places, long[] tokens) {
            boolean passes(TokenGame now) {
                for (var i = 0; i < places.length; i++) {
                    if (now.tokens(places[i]) != tokens[i]) {
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
         * Makes the search follow other transitions too at each marking that equals the entry of {@code component} on
         * all places next to the component's firings.
         */
        void open(TerminalComponent component) {
            var looping = new boolean[net.transitions().size()];
            var around = new boolean[net.places().size()];
            for (var t : net.transitions()) {
                if (component.fires(t)) {
                    looping[t.index()] = true;
                    t.inputs().forEach(arc -> around[arc.place().index()] = true);
                    t.outputs().forEach(arc -> around[arc.place().index()] = true);
                    t.inhibitors().forEach(arc -> around[arc.place().index()] = true);
                }
            }
            var places = net.places().stream()
                    .mapToInt(Place::index)
                    .filter(place -> around[place])
                    .toArray();
            var entry = component.entry().marking().toArray();
            var tokens = new long[places.length];
            for (var i = 0; i < places.length; i++) {
                tokens[i] = entry[places[i]];
            }
            loops.add(new Loop(looping, places, tokens));
        }

        @Override
        public int choose(TokenGame game, int[] chosen) {
            var count = sets.choose(game, chosen);
            for (var loop : loops) {
                if (loop.passes(game)) {
                    count = sets.widen(game, chosen, count, loop.transitions());
                }
            }
            return count;
        }
    }
}
