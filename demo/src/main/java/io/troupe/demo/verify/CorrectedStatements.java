package io.troupe.demo.verify;

import io.troupe.petri.Marking;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.petri.Verdict;
import io.troupe.petri.structure.DeadlockVerdict;
import io.troupe.petri.structure.SiphonAnalysis;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.OptionalInt;

/** What the paper says about the net whose components stop together. */
final class CorrectedStatements {
    private final Reading reading;
    private final NetStudy study;

    CorrectedStatements(Reading reading, NetStudy study) {
        this.reading = reading;
        this.study = study;
    }

    List<Statement> all() {
        return List.of(inevitableStop(), once(), noEmptySiphon(), noDeadPlace(), deadlockFree());
    }

    private Statement inevitableStop() {
        var wantsToStop = study.net().marking("R10");
        List<State> stopping = study.graph().states().stream()
                .filter(state -> state.marking().covers(wantsToStop))
                .toList();
        var longest = new HashMap<State, OptionalInt>();
        OptionalInt firings = stopping.stream()
                .map(state -> longestWay(state, wantsToStop, longest))
                .reduce(OptionalInt.of(0), CorrectedStatements::longer);
        var stop = study.net().transition("Tstop");
        List<State> before = study.graph().states().stream()
                .filter(state -> state.successors().stream()
                        .anyMatch(edge -> edge.transition().equals(stop)))
                .toList();
        return new Statement(
                "5.5.4",
                "once R10 is marked all must stop, since there is no other path to select",
                "R10 is marked in %d markings, and Tstop may fire in %d of all; %s"
                        .formatted(
                                stopping.size(),
                                before.size(),
                                firings.isPresent()
                                        ? "from R10 every way leads to it, after at most " + firings.getAsInt()
                                                + " other firings"
                                        : "there is a way round in circles that avoids it"),
                firings.isPresent() && before.size() == 1,
                before.stream()
                        .limit(1)
                        .map(state -> "Tstop fires in " + state + ", first after "
                                + state.shortestTrace().size() + " firings")
                        .toList());
    }

    /**
     * The most firings until R10 loses its token; nothing if one can go round in circles, or end before. The graph is some hundred markings
     * large, so the recursion is not deep.
     */
    private static OptionalInt longestWay(State from, Marking wantsToStop, Map<State, OptionalInt> known) {
        var before = known.get(from);
        if (before != null) {
            return before;
        }
        known.put(from, OptionalInt.empty()); // whoever comes here again on the way goes round in circles
        var longest = from.successors().isEmpty() ? OptionalInt.empty() : OptionalInt.of(0);
        for (var edge : from.successors()) {
            if (edge.target().marking().covers(wantsToStop)) {
                var rest = longestWay(edge.target(), wantsToStop, known);
                longest = longer(longest, rest.isPresent() ? OptionalInt.of(rest.getAsInt() + 1) : rest);
            }
        }
        known.put(from, longest);
        return longest;
    }

    private static OptionalInt longer(OptionalInt one, OptionalInt other) {
        return one.isEmpty() || other.isEmpty()
                ? OptionalInt.empty()
                : OptionalInt.of(Math.max(one.getAsInt(), other.getAsInt()));
    }

    private Statement once() {
        // between two stops Tms2'' and Trp2'' cannot fire twice if each needs a place that only Tstop marks again
        boolean holds = List.of("P1", "S1").stream()
                .allMatch(place -> study.net().transitions().stream()
                        .filter(each -> each.outputs().stream()
                                .anyMatch(arc -> arc.place().name().equals(place)))
                        .allMatch(each -> each.name().equals("Tstop")));
        return new Statement(
                "5.5.4",
                "player gives proxies, and service registers, one time only",
                holds
                        ? "once from start to stop: only Tstop puts tokens back on P1 and S1"
                        : "other transitions than Tstop put tokens back on P1 or S1",
                holds,
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
        DeadlockVerdict bySiphons =
                SiphonAnalysis.of(PaperNets.corrected(reading)).deadlock();
        boolean proved = bySiphons instanceof DeadlockVerdict.NoDeadMarking;
        boolean byTraps = bySiphons instanceof DeadlockVerdict.NoDeadMarking proof && proof.isByTrapsAlone();
        return new Statement(
                "5.5.4",
                "the corrected model is free of deadlock",
                "%d of %d reachable markings are dead; %s"
                        .formatted(
                                study.graph().dead().size(),
                                study.graph().size(),
                                byTraps
                                        ? "proved without any search too: every minimal siphon contains a marked trap"
                                        : proved ? "proved by its siphons too" : "its siphons alone do not prove it"),
                study.deadlockFree() && proved,
                List.of());
    }
}
