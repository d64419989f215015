package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/**
 * The proposal to fuse all stops into one that the components take together, each where it waits for its next call.
 *
 * @param wiring the changed wiring
 * @param stops in which state (or in which of several) each component takes part
 * @param result what the check of the changed wiring says
 */
public record Repair(Wiring wiring, Map<String, List<String>> stops, WiringResult result) {
    public Repair {
        requireNonNull(wiring, "wiring");
        stops = Map.copyOf(stops);
        requireNonNull(result, "result");
    }

    /** Whether the changed wiring is proved to be free of deadlock. */
    public boolean isProved() {
        return result instanceof WiringResult.Proved;
    }

    @Override
    public String toString() {
        return "fuse the stops into one, taken together in the states " + new TreeMap<>(stops) + ": "
                + (isProved() ? "proved free of deadlock, " : "not proved, ") + result.figures();
    }
}
