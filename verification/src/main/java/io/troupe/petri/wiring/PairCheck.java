package io.troupe.petri.wiring;

import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;

/**
 * Checks every two components that call each other separately from the rest. Of several pairs with the same net only
 * one is searched.
 */
final class PairCheck {
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
