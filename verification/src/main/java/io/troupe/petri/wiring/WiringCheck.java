package io.troupe.petri.wiring;

import io.troupe.petri.ReachabilityGraph;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;

/**
 * Tells whether the components of a {@link Wiring} can come to wait for each other for ever.
 *
 * <p>The nets of the components are melded, first of every two that call each other, then of all, and each is searched
 * breadth first. In a unit test:
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
 * <p><b>Cost.</b> That of {@link ReachabilityGraph#explore}, for each pair, the whole, and the repaired whole; the
 * markings of the whole grow exponentially with the number of components.
 * <p><b>Errors.</b> A limit below 1, and a wiring that {@link Wiring#withSynchronisedStop} made with more than 1000
 * combinations of states to stop in, throw {@link IllegalArgumentException}.
 * <p><b>Source.</b> Sections 5.5 and 5.6 of the paper.
 */
public final class WiringCheck {
    private WiringCheck() {}

    /** Visits up to {@link ReachabilityGraph#DEFAULT_MAX_MARKINGS} markings of each net. */
    public static WiringResult check(Wiring wiring) {
        return check(wiring, ReachabilityGraph.DEFAULT_MAX_MARKINGS);
    }

    /**
     * Visits up to {@code maxMarkings} (1 or more) markings of each net. A deadlock within the limit is a real one; if
     * none was met and the limit was, the result is {@link WiringResult.Unknown}.
     */
    public static WiringResult check(Wiring wiring, int maxMarkings) {
        var pairs = pairs(wiring, maxMarkings);
        var whole = new Search(wiring, new LinkedHashSet<>(wiring.components()), maxMarkings);
        var figures = whole.figures();
        var deadlocks = whole.deadlocks();
        var blocks = whole.blocks();
        if (!deadlocks.isEmpty()) {
            return new WiringResult.Deadlock(figures, pairs, deadlocks, blocks, repair(wiring, maxMarkings));
        }
        if (!figures.isComplete()) {
            return new WiringResult.Unknown(figures, pairs);
        }
        return blocks.isEmpty()
                ? new WiringResult.Proved(figures, pairs)
                : new WiringResult.Blocked(figures, pairs, blocks, repair(wiring, maxMarkings));
    }

    private static List<PairResult> pairs(Wiring wiring, int maxMarkings) {
        var results = new ArrayList<PairResult>();
        var components = wiring.components();
        for (var i = 0; i < components.size(); i++) {
            for (var other : components.subList(i + 1, components.size())) {
                var one = components.get(i);
                if (calls(wiring, one, other) || calls(wiring, other, one)) {
                    results.add(pair(wiring, one, other, maxMarkings));
                }
            }
        }
        return List.copyOf(results);
    }

    private static boolean calls(Wiring wiring, String caller, String provider) {
        return wiring.protocol(caller).requests().stream()
                .anyMatch(request -> wiring.provider(caller, request).equals(provider));
    }

    private static PairResult pair(Wiring wiring, String one, String other, int maxMarkings) {
        var chosen = new LinkedHashSet<>(List.of(one, other));
        var search = new Search(wiring, chosen, maxMarkings);
        var deadlocks = search.deadlocks();
        return new PairResult(one, other, search.figures(), deadlocks.isEmpty() ? search.blocks() : deadlocks);
    }

    private static Optional<Repair> repair(Wiring wiring, int maxMarkings) {
        var together = wiring.withSynchronisedStop();
        var stops = new LinkedHashMap<String, List<String>>();
        for (var component : wiring.components()) {
            var states = together.stops(component);
            if (!states.isEmpty()) {
                stops.put(component, states);
            }
        }
        var combinations = stops.values().stream().mapToDouble(List::size).reduce(1, (a, b) -> a * b);
        if (wiring.stopsTogether() || stops.isEmpty() || combinations > WiringNet.MAX_COMBINATIONS) {
            return Optional.empty();
        }
        return Optional.of(new Repair(together, stops, check(together, maxMarkings)));
    }
}
