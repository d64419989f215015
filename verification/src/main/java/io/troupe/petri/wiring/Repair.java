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

    /** Whether in the changed wiring, as {@link WiringResult.Proved} says, every component can always go on. */
    public boolean isProved() {
        return result instanceof WiringResult.Proved;
    }

    /** Whether the changed wiring is proved to have no dead marking; a component may still be blocked by itself. */
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
                "not proved, a component can wait for ever, " + blocked.story().sentence() + "; " + blocked.figures();
            case WiringResult.Deadlock deadlock ->
                "not proved, can deadlock, " + deadlock.story().sentence() + "; " + deadlock.figures();
            case WiringResult.Unknown unknown -> "not proved, " + unknown;
        };
        return "fuse the stops into one, taken together in the states " + new TreeMap<>(stops) + ": " + verdict;
    }
}
