package io.troupe.petri.wiring;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;

/**
 * Tells whether the components of a {@link Wiring} can come to wait for each other for ever.
 *
 * <p>The nets of the components are melded, first of every two that call each other, then of all. A pair is searched in
 * full. Of the whole, a search by stubborn sets finds all dead markings, with a shortest way to each, among a small part
 * of the markings; where the full graph is within the limit too, it tells whether some components can be blocked while
 * others go on, and how that begins. What was beyond the limit, the result says. In a unit test:
 *
 * {@snippet :
 * @Test
 * void components_neverDeadlock() {
 *     var wiring = Wiring.of("demo").component(robot()).component(player()).build();
 *     assertThat(WiringCheck.check(wiring)).isInstanceOf(WiringResult.Proved.class);
 * }
 * }
 *
 * When this fails, its message is the story of the deadlock.
 *
 * <p><b>Threads.</b> Any.
 * <p><b>Cost.</b> That of {@link DeadlockSearch#run} and of {@link ReachabilityGraph#explore}, for each pair (alike
 * ones once), the whole, and the repaired whole; the markings of the whole grow exponentially with the number of
 * components. After a deadlock the graph is not followed beyond 200,000 markings.
 * <p><b>Errors.</b> A limit below 1, and a wiring that {@link Wiring#withSynchronisedStop} made with more than 1000
 * combinations of states to stop in, throw {@link IllegalArgumentException}.
 * <p><b>Source.</b> Sections 5.5 and 5.6 of the paper.
 */
public final class WiringCheck {
    /** The limit of {@link #check(Wiring)}: a second or two for each search, and some 100 MiB. */
    public static final int DEFAULT_MAX_MARKINGS = 500_000;

    /** With the verdict known, the graph tells only how it begins; so it must not take longer than the verdict did. */
    private static final int MAX_MARKINGS_FOR_CAUSES = 200_000;

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
     * Searches as far as {@code limits} allow; they hold for each search, and each search reports from its own
     * beginning. Once cancelled, the result says what was found until then.
     */
    public static WiringResult check(Wiring wiring, SearchLimits limits) {
        var pairs = new PairCheck(wiring, limits).results();
        var net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
        var reduced = DeadlockSearch.run(net.net(), limits);
        var dead = reduced.deadlocks();
        var isSettled = !dead.isEmpty() && reduced.end() == SearchEnd.COMPLETE;
        var graph = ReachabilityGraph.explore(net.net(), isSettled ? atMost(limits, MAX_MARKINGS_FOR_CAUSES) : limits);
        var whole = new Search(wiring, net, graph);
        var figures = whole.figures();
        var reducedFigures = ReducedFigures.of(reduced);
        var deadlocks = dead.isEmpty() ? whole.deadlocks() : whole.deadlocks(dead);
        var blocks = whole.blocks();
        if (!deadlocks.isEmpty()) {
            return new WiringResult.Deadlock(figures, reducedFigures, pairs, deadlocks, blocks, repair(wiring, limits));
        }
        if (!blocks.isEmpty()) {
            return new WiringResult.Blocked(figures, reducedFigures, pairs, blocks, repair(wiring, limits));
        }
        if (figures.isComplete()) {
            return new WiringResult.Proved(figures, reducedFigures, pairs);
        }
        return reducedFigures.isComplete()
                ? new WiringResult.DeadlockFree(figures, reducedFigures, pairs)
                : new WiringResult.Unknown(figures, reducedFigures, pairs);
    }

    private static SearchLimits atMost(SearchLimits limits, int markings) {
        return new SearchLimits(
                Math.min(limits.maxMarkings(), markings),
                limits.cancelled(),
                limits.markingsPerReport(),
                limits.report());
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
}
