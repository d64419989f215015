package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/**
 * A proposed repair: all stops are fused into one that the components take together, each where it waits for its next
 * call.
 *
 * @param wiring the changed wiring
 * @param stops by component: the state, or the states, in which it takes part
 * @param result the check of the changed wiring
 */
public record Repair(Wiring wiring, Map<String, List<String>> stops, WiringResult result) {
    public Repair {
        requireNonNull(wiring, "wiring");
        stops = Map.copyOf(stops);
        requireNonNull(result, "result");
    }

    /** Whether every component of the changed wiring can always go on, in the sense of {@link WiringResult.Proved}. */
    public boolean isProved() {
        return result instanceof WiringResult.Proved;
    }

    /** Whether the changed wiring is proved to have no dead marking; a single component may still be blocked. */
    public boolean isDeadlockFree() {
        return result instanceof WiringResult.Proved
                || result instanceof WiringResult.DeadlockFree
                || result instanceof WiringResult.Blocked;
    }

    @Override
    public String toString() {
        var verdict = switch (result) {
            case WiringResult.Proved proved -> proved.toString();
            case WiringResult.DeadlockFree free -> free.toString();
            case WiringResult.Blocked blocked ->
                "not proved, a component can wait for ever, "
                        + blocked.counterexample().sentence() + "; " + blocked.figures();
            case WiringResult.Deadlock deadlock ->
                "not proved, can deadlock, " + deadlock.counterexample().sentence() + "; " + deadlock.figures();
            case WiringResult.Unknown unknown -> "not proved, " + unknown;
        };
        return "fuse the stops into one, taken together in the states " + new TreeMap<>(stops) + ": " + verdict;
    }
}
