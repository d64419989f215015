package io.troupe.petri.wiring;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;

/** One transition in which some components stop together; there is one for each combination of their states. */
record SynchronisedStop(String name, Map<String, String> states) {
    static final int MAX_COMBINATIONS = 1000;

    /** All synchronised stops of the components {@code chosen}. */
    static List<SynchronisedStop> of(Wiring wiring, Set<String> chosen) {
        var all = new ArrayList<SynchronisedStop>();
        for (var group : wiring.stopGroups()) {
            var combinations = combinations(wiring, group, chosen);
            var isWhole = group.containsAll(wiring.components());
            for (var states : combinations) {
                var who = isWhole ? "all" : String.join(" and ", states.keySet());
                all.add(new SynchronisedStop(who + " stop" + (combinations.size() == 1 ? "" : ": " + states), states));
            }
        }
        return List.copyOf(all);
    }

    /** Whether every group has few enough combinations of states for a net. */
    static boolean isFeasible(Wiring wiring) {
        return wiring.stopGroups().stream()
                .allMatch(group -> group.stream()
                                .mapToDouble(component ->
                                        Math.max(1, wiring.stops(component).size()))
                                .reduce(1, (a, b) -> a * b)
                        <= MAX_COMBINATIONS);
    }

    private static List<Map<String, String>> combinations(Wiring wiring, Set<String> group, Set<String> chosen) {
        List<Map<String, String>> all = List.of(new LinkedHashMap<>());
        for (var component : wiring.components()) {
            var takesPart = chosen.contains(component) && group.contains(component);
            var states = takesPart ? wiring.stops(component) : List.<String>of();
            if (states.isEmpty()) {
                continue;
            }
            if ((long) all.size() * states.size() > MAX_COMBINATIONS) {
                throw new IllegalArgumentException("wiring " + wiring.name() + ": a synchronised stop would need more"
                        + " than " + MAX_COMBINATIONS + " combinations of states; expected fewer states to stop in");
            }
            all = all.stream()
                    .flatMap(one -> states.stream().map(state -> {
                        Map<String, String> more = new LinkedHashMap<>(one);
                        more.put(component, state);
                        return more;
                    }))
                    .toList();
        }
        return all.get(0).isEmpty() ? List.of() : all;
    }

    /**
     * The components of {@code chosen} that {@code component} would stop together with and that cannot stop in their
     * present {@code states}.
     */
    static Set<String> missing(Wiring wiring, String component, Set<String> chosen, Map<String, String> states) {
        var missing = new TreeSet<String>();
        for (var group : wiring.stopGroups()) {
            for (var other : group.contains(component) ? group : Set.<String>of()) {
                var stops = chosen.contains(other) ? wiring.stops(other) : List.<String>of();
                if (!stops.isEmpty() && !stops.contains(states.getOrDefault(other, ""))) {
                    missing.add(other);
                }
            }
        }
        return missing;
    }
}
