package io.troupe.demo.verify;

import io.troupe.demo.verify.ReadingStudy.Statement;
import io.troupe.petri.Marking;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.Edge;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.petri.Transition;
import io.troupe.petri.Verdict;
import java.util.ArrayDeque;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.OptionalInt;

/** The paper's statements about the corrected net, whose components stop together. */
final class CorrectedStatements {
    private final NetStudy study;
    private final StopPaths paths;

    CorrectedStatements(NetStudy study) {
        this.study = study;
        paths = new StopPaths(study.graph(), study.net().transition("Tstop"));
    }

    List<Statement> all() {
        return List.of(inevitableStop(), once(), noEmptySiphon(), noDeadPlace(), deadlockFree());
    }

    private Statement inevitableStop() {
        var wantsToStop = study.net().marking("R10");
        OptionalInt firings = paths.longest(wantsToStop);
        List<State> before = study.graph().states().stream()
                .filter(state -> state.successors().stream()
                        .anyMatch(edge -> edge.transition().equals(paths.stop())))
                .toList();
        return new Statement(
                "5.5.4",
                "once R10 is marked all must stop, since there is no other path to select",
                "R10 is marked in %d markings, and Tstop may fire in %d of all; %s"
                        .formatted(
                                study.markingsWith(wantsToStop),
                                before.size(),
                                firings.isPresent()
                                        ? "from R10 every way leads to it, after at most " + firings.getAsInt()
                                                + " other firings"
                                        : "not every way from R10 leads to it"),
                firings.isPresent() && before.size() == 1,
                before.stream()
                        .limit(1)
                        .map(state -> "Tstop fires in " + state + ", first after "
                                + state.shortestTrace().size() + " firings")
                        .toList());
    }

    private Statement once() {
        var gives = List.of(study.net().transition("Trp2''"), study.net().transition("Tms2''"));
        List<Transition> repeated = gives.stream().filter(paths::canRepeat).toList();
        boolean fire = study.graph().neverFired().stream().noneMatch(gives::contains);
        return new Statement(
                "5.5.4",
                "player gives proxies, and service registers, one time only",
                repeated.isEmpty()
                        ? "once from start to stop: neither Trp2'' nor Tms2'' fires twice without Tstop between"
                        : "these fire twice without Tstop between: " + repeated,
                repeated.isEmpty() && fire,
                List.of());
    }

    private Statement noEmptySiphon() {
        return new Statement(
                "5.5.4",
                "no siphon can lose all its tokens",
                "%d minimal siphons: the linear programs leave at least %.0f token in each, visiting all markings finds %d empty, and %d are without a marked trap"
                        .formatted(
                                study.siphons().sets().size(),
                                study.fewestTokens(),
                                study.emptied().size(),
                                study.withoutMarkedTrap().size()),
                study.emptied().isEmpty() && study.emptiedByTheStateEquation() == 0,
                List.of());
    }

    private Statement noDeadPlace() {
        var graph = study.graph();
        return new Statement(
                "5.5.4",
                "no place is dead",
                "places that are never marked: %d, transitions that never fire: %d; live: %s, reversible: %s"
                        .formatted(
                                graph.neverMarked().size(),
                                graph.neverFired().size(),
                                word(study.liveness().live()),
                                word(study.liveness().reversible())),
                graph.neverMarked().isEmpty(),
                List.of());
    }

    private static String word(Verdict verdict) {
        return switch (verdict) {
            case YES -> "yes";
            case NO -> "no";
            case UNKNOWN -> "not known";
        };
    }

    private Statement deadlockFree() {
        // in a dead marking the places without tokens are a siphon: here every transition takes single tokens
        boolean byTraps = study.withoutMarkedTrap().isEmpty();
        return new Statement(
                "5.5.4",
                "the corrected model is free of deadlock",
                "%d of %d reachable markings are dead; %s"
                        .formatted(
                                study.graph().dead().size(),
                                study.graph().size(),
                                byTraps
                                        ? "proved without any search too: every minimal siphon contains a marked trap"
                                        : "its siphons alone do not prove it"),
                study.deadlockFree() && byTraps,
                List.of());
    }

    /** Analyses the paths through a graph up to the firing of {@code stop}. */
    private record StopPaths(ReachabilityGraph graph, Transition stop) {
        /**
         * The largest number of other firings before {@code stop} fires, from any marking with {@code wanting} marked.
         * Empty if there is no such marking, or if some path avoids {@code stop}: by a cycle, a dead marking, or
         * another transition that takes the tokens.
         */
        OptionalInt longest(Marking wanting) {
            var known = new HashMap<State, OptionalInt>();
            return graph.states().stream()
                    .filter(state -> state.marking().covers(wanting))
                    .map(state -> longest(state, wanting, known))
                    .reduce(StopPaths::longer)
                    .orElse(OptionalInt.empty());
        }

        /** Recursive; the graph has some hundred markings, so the recursion is not deep. */
        private OptionalInt longest(State from, Marking wanting, Map<State, OptionalInt> known) {
            var before = known.get(from);
            if (before != null) {
                return before;
            }
            known.put(from, OptionalInt.empty()); // marks the state as in progress: reaching it again is a cycle
            var longest = from.successors().stream()
                    .map(edge -> rest(edge, wanting, known))
                    .reduce(StopPaths::longer)
                    .orElse(OptionalInt.empty());
            known.put(from, longest);
            return longest;
        }

        private OptionalInt rest(Edge edge, Marking wanting, Map<State, OptionalInt> known) {
            if (edge.transition().equals(stop)) {
                return OptionalInt.of(0);
            }
            if (!edge.target().marking().covers(wanting)) {
                return OptionalInt.empty();
            }
            var rest = longest(edge.target(), wanting, known);
            return rest.isPresent() ? OptionalInt.of(rest.getAsInt() + 1) : rest;
        }

        private static OptionalInt longer(OptionalInt one, OptionalInt other) {
            return one.isEmpty() || other.isEmpty()
                    ? OptionalInt.empty()
                    : OptionalInt.of(Math.max(one.getAsInt(), other.getAsInt()));
        }

        /** Whether {@code transition} can fire twice without {@code stop} in between. */
        boolean canRepeat(Transition transition) {
            List<State> after = graph.states().stream()
                    .flatMap(state -> state.successors().stream())
                    .filter(edge -> edge.transition().equals(transition))
                    .map(Edge::target)
                    .toList();
            var seen = new HashSet<>(after);
            var ahead = new ArrayDeque<>(seen);
            while (!ahead.isEmpty()) {
                for (var edge : ahead.remove().successors()) {
                    if (edge.transition().equals(transition)) {
                        return true;
                    }
                    if (!edge.transition().equals(stop) && seen.add(edge.target())) {
                        ahead.add(edge.target());
                    }
                }
            }
            return false;
        }
    }
}
