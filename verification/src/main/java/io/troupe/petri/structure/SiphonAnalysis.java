package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.function.BooleanSupplier;
import java.util.function.Supplier;

/**
 * The minimal siphons of a net, whether each can be emptied, and what follows for dead markings.
 *
 * <p><b>Role.</b> Tries the cheapest proof first: a marked trap, then the state equation. A siphon that neither decides
 * is a candidate for {@link #confirm}.
 *
 * <p><b>Cost.</b> The search for all minimal siphons, and two linear programs for each siphon without a marked trap.
 *
 * @param siphons the result of the search
 * @param verdicts one for each of these siphons, in their order
 */
public record SiphonAnalysis(PetriNet net, MinimalSets siphons, List<SiphonVerdict> verdicts) {
    public SiphonAnalysis {
        verdicts = List.copyOf(verdicts);
    }

    private static final Duration FOR_EVER = Duration.ofDays(365);

    /** Judges all minimal siphons found in up to {@link Siphons#DEFAULT_MAX_STEPS} steps. */
    public static SiphonAnalysis of(PetriNet net) {
        return of(net, Siphons.DEFAULT_MAX_STEPS);
    }

    /** Judges all minimal siphons found in up to {@code maxSteps} (1 or more) steps. */
    public static SiphonAnalysis of(PetriNet net, long maxSteps) {
        return of(net, maxSteps, () -> FOR_EVER);
    }

    /**
     * Judges the minimal siphons found in up to {@code maxSteps} (1 or more) steps, within a time limit.
     *
     * @param left the remaining time, called often and on the calling thread; once it is zero or less, the search ends,
     *     and siphons that are not judged yet count as {@link SiphonVerdict.MayBeEmptied}
     */
    public static SiphonAnalysis of(PetriNet net, long maxSteps, Supplier<Duration> left) {
        BooleanSupplier cancelled = () -> !left.get().isPositive();
        var siphons = Siphons.minimalSiphons(net, maxSteps, cancelled);
        var equation = new StateEquation(net, left);
        return new SiphonAnalysis(
                net,
                siphons,
                siphons.sets().stream()
                        .map(siphon -> cancelled.getAsBoolean()
                                ? new SiphonVerdict.MayBeEmptied(siphon, OptionalDouble.empty())
                                : judge(siphon, equation))
                        .toList());
    }

    /** Judges a siphon by traps and the state equation: a proof that it cannot be emptied, or a candidate. */
    public static SiphonVerdict judge(PlaceSet siphon) {
        requireSiphon(siphon);
        return judge(siphon, new StateEquation(siphon.net()));
    }

    private static SiphonVerdict judge(PlaceSet siphon, StateEquation equation) {
        var byTrap = markedTrap(siphon);
        if (byTrap.isPresent()) {
            return byTrap.get();
        }
        var least = equation.leastTokens(siphon);
        return equation.lowerBound(siphon)
                .<SiphonVerdict>map(SiphonVerdict.HoldsTokens::new)
                .orElse(new SiphonVerdict.MayBeEmptied(siphon, least));
    }

    private static Optional<SiphonVerdict> markedTrap(PlaceSet siphon) {
        var trap = Siphons.largestTrapIn(siphon);
        return trap.isMarked(siphon.net().initialMarking())
                ? Optional.of(new SiphonVerdict.HoldsMarkedTrap(siphon, trap))
                : Optional.empty();
    }

    /**
     * Searches the graph for a marking in which the siphon is empty: the result is the nearest one, a proof that there
     * is none, or, if the graph is incomplete, a candidate.
     */
    public static SiphonVerdict confirm(PlaceSet siphon, ReachabilityGraph graph) {
        requireSiphon(siphon);
        siphon.requirePlacesOf(graph.net());
        var emptied = graph.states().stream()
                .filter(state -> !siphon.isMarked(state.marking()))
                .findFirst();
        if (emptied.isPresent()) {
            return new SiphonVerdict.Emptied(siphon, emptied.get());
        }
        return graph.isComplete()
                ? new SiphonVerdict.NeverEmpty(siphon)
                : new SiphonVerdict.MayBeEmptied(siphon, OptionalDouble.empty());
    }

    private static void requireSiphon(PlaceSet set) {
        if (set.isEmpty() || !Siphons.isSiphon(set)) {
            throw new IllegalArgumentException(
                    set + " is not a siphon of net " + set.net().name());
        }
    }

    /** What follows for dead markings of the net; its priorities are respected. */
    public DeadlockVerdict deadlock() {
        var unfit = whyUnfit(net);
        if (unfit.isPresent()) {
            return new DeadlockVerdict.Undecided(unfit.get());
        }
        var proofs = verdicts.stream()
                .filter(SiphonVerdict.CannotBeEmptied.class::isInstance)
                .map(SiphonVerdict.CannotBeEmptied.class::cast)
                .toList();
        if (proofs.size() < verdicts.size()) {
            return new DeadlockVerdict.Candidates(verdicts.stream()
                    .filter(verdict -> !(verdict instanceof SiphonVerdict.CannotBeEmptied))
                    .toList());
        }
        if (!siphons.isComplete()) {
            return new DeadlockVerdict.Undecided("net " + net.name() + ": none of the " + proofs.size()
                    + " minimal siphons found can be emptied, but the search stopped at its limit, or was cancelled");
        }
        return new DeadlockVerdict.NoDeadMarking(proofs);
    }

    /** The reason why a dead marking of this net need not have an empty siphon; empty if there is none. */
    static Optional<String> whyUnfit(PetriNet net) {
        if (net.transitions().isEmpty()) {
            return Optional.of("net " + net.name() + " has no transitions: its only marking is dead");
        }
        if (net.hasInhibitors()) {
            return Optional.of(
                    "net " + net.name() + " has inhibitor arcs, so a dead marking need not have an empty siphon");
        }
        return net.transitions().stream()
                .flatMap(t -> t.inputs().stream()
                        .filter(arc -> arc.weight() > 1)
                        .map(arc -> "net " + net.name() + ": the arc " + arc.place() + " -> " + t + " has weight "
                                + arc.weight() + ", so a dead marking need not have an empty siphon"))
                .findFirst();
    }
}
