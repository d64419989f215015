package io.troupe.petri.wiring;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;

/**
 * Checks whether the components of a {@link Wiring} can come to wait for each other for ever.
 *
 * <p>The nets of the components are melded, first of every two that call each other, then of all. A pair is searched in
 * full. In the whole, a search by stubborn sets finds all dead markings, with a shortest trace to each, among a small
 * part of the markings. If there are none, another search decides whether some components can be blocked while others
 * go on. The full graph, within the limit, adds its figures and how a block begins, and decides what the other searches
 * could not. The result reports what was beyond all limits. In a unit test:
 *
 * {@snippet :
 * @Test
 * void components_neverDeadlock() {
 *     var wiring = Wiring.of("demo").component(client()).component(planner()).build();
 *     assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved.class);
 * }
 * }
 *
 * If this fails, its message is the counterexample of the deadlock.
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> That of {@link DeadlockSearch#run}, {@link ProgressSearch#run} and {@link ReachabilityGraph#explore},
 * for each pair (those with the same net once), the whole, and the repaired whole. The markings of the whole grow
 * exponentially with the number of components. Once the verdict is known, the full graph ends at 300,000 markings.
 *
 * <p><b>Errors.</b> A limit below 1, and a wiring whose {@link Wiring#withSynchronisedStop synchronised stop} has more
 * than 1000 combinations of states, throw {@link IllegalArgumentException}.
 *
 * <p><b>Source.</b> Sections 5.5 and 5.6 of the paper.
 */
public final class WiringCheck {
    /** The limit of {@link #check(Wiring)}: a second or two for each search, and some 100 MiB. */
    public static final int DEFAULT_MAX_MARKINGS = 500_000;

    /**
     * The limit once the verdict is known: the full graph then only adds figures and causes, which are not worth more
     * than a second.
     */
    private static final int MAX_MARKINGS_IF_KNOWN = 300_000;

    private WiringCheck() {}

    /** Visits up to {@link #DEFAULT_MAX_MARKINGS} markings in each search. */
    public static WiringResult check(Wiring wiring) {
        return check(wiring, DEFAULT_MAX_MARKINGS);
    }

    /** Visits up to {@code maxMarkings} (1 or more) markings in each search. */
    public static WiringResult check(Wiring wiring, int maxMarkings) {
        return check(wiring, SearchLimits.markings(maxMarkings));
    }

    /**
     * Searches within {@code limits}; they apply to each search, and each search reports its progress separately. Once
     * cancelled, the result contains what was found until then.
     */
    public static WiringResult check(Wiring wiring, SearchLimits limits) {
        var pairs = new PairCheck(wiring, limits).results();
        var net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
        var search = DeadlockSearch.run(net.net(), limits);
        var dead = search.deadlocks();
        var mayBeFree = dead.isEmpty() && search.end() == SearchEnd.COMPLETE;
        var progress =
                mayBeFree ? Optional.of(ProgressSearch.run(net.net(), limits)) : Optional.<ProgressSearch>empty();
        var settled = progress.filter(found -> found.end() == SearchEnd.COMPLETE);
        var isKnown = settled.isPresent() || !dead.isEmpty();
        var graph = ReachabilityGraph.explore(net.net(), isKnown ? limits.atMost(MAX_MARKINGS_IF_KNOWN) : limits);
        var whole = new WiringSearch(wiring, net, graph);
        var figures = whole.figures();
        var reduced = settled.map(ReducedFigures::of).orElse(ReducedFigures.of(search));
        var deadlocks = dead.isEmpty() ? whole.deadlocks() : whole.deadlocks(dead);
        var blocks = figures.isComplete()
                ? whole.blocks()
                : whole.blocks(settled.map(ProgressSearch::losses).orElse(List.of()));
        if (!deadlocks.isEmpty()) {
            return new WiringResult.Deadlock(figures, reduced, pairs, deadlocks, blocks, repair(wiring, limits));
        }
        if (!blocks.isEmpty()) {
            return new WiringResult.Blocked(figures, reduced, pairs, blocks, repair(wiring, limits));
        }
        if (figures.isComplete() || settled.isPresent()) {
            return new WiringResult.Proved(figures, reduced, pairs);
        }
        return reduced.isComplete()
                ? new WiringResult.DeadlockFree(figures, reduced, pairs)
                : new WiringResult.Unknown(figures, reduced, pairs);
    }

    private static Optional<Repair> repair(Wiring wiring, SearchLimits limits) {
        var together = wiring.withSynchronisedStop();
        var stops = new LinkedHashMap<String, List<String>>();
        for (var component : wiring.components()) {
            var states = together.stops(component);
            if (!states.isEmpty()) {
                stops.put(component, states);
            }
        }
        if (wiring.stopsTogether() || stops.isEmpty() || !SynchronisedStop.isFeasible(together)) {
            return Optional.empty();
        }
        return Optional.of(new Repair(together, stops, check(together, limits)));
    }

    /**
     * Checks every two components that call each other separately from the rest. Of several pairs with the same net
     * only one is searched.
     */
    static final class PairCheck {
        private final Wiring wiring;
        private final SearchLimits limits;
        private final Map<List<List<Integer>>, ReachabilityGraph> searched = new HashMap<>();

        PairCheck(Wiring wiring, SearchLimits limits) {
            this.wiring = wiring;
            this.limits = limits;
        }

        List<PairResult> results() {
            var results = new ArrayList<PairResult>();
            var components = wiring.components();
            for (var i = 0; i < components.size(); i++) {
                for (var other : components.subList(i + 1, components.size())) {
                    var one = components.get(i);
                    if (calls(one, other) || calls(other, one)) {
                        results.add(result(one, other));
                    }
                }
            }
            return List.copyOf(results);
        }

        /** The number of nets that were searched. */
        int searched() {
            return searched.size();
        }

        private boolean calls(String caller, String provider) {
            return wiring.protocol(caller).requests().stream()
                    .anyMatch(request -> wiring.provider(caller, request).equals(provider));
        }

        private PairResult result(String one, String other) {
            var net = new WiringNet(wiring, new LinkedHashSet<>(List.of(one, other)));
            var graph = searched.computeIfAbsent(net.shape(), shape -> ReachabilityGraph.explore(net.net(), limits));
            var search = new WiringSearch(wiring, net, graph);
            var deadlocks = search.deadlocks();
            return new PairResult(one, other, search.figures(), deadlocks.isEmpty() ? search.blocks() : deadlocks);
        }
    }
}
