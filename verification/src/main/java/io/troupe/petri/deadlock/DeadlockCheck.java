package io.troupe.petri.deadlock;

import static java.lang.System.Logger.Level.WARNING;

import io.troupe.petri.Answer;
import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.DeadlockSearch.Deadlock;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Symmetry;
import io.troupe.petri.Transition;
import io.troupe.petri.structure.DeadlockEquation;
import java.util.Arrays;
import java.util.EnumSet;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;

/**
 * Decides whether a net is free of deadlock: whether it never reaches a marking in which no transition may fire. It
 * needs far fewer markings than {@link DeadlockSearch}, but finds one dead marking and not all of them, and its trace
 * is not always a shortest one.
 *
 * <p>The net is reduced first, by rules that keep whether it can deadlock. Then come, from cheap to dear, a short hunt
 * for a counterexample, a proof without a search, a longer hunt, and last all markings of the reduced net by stubborn
 * sets; of markings that differ only in which of some equal parts is in which state, one ({@link Symmetry}). A trace
 * that was found is translated to the net and fired there, and firings that it does not need are left out. Should it
 * not lead to a dead marking of the net, the net is searched without reductions.
 *
 * {@snippet :
 * var result = DeadlockCheck.decide(net, SearchLimits.markings(1_000_000));
 * assertThat(result).isInstanceOf(Yes.class);
 * }
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> The hunts and proofs have separate limits, a second or two together for a net of some thousand
 * places. The last search is that of {@link DeadlockSearch#run} on the reduced net.
 *
 * <p><b>Errors.</b> A place that can hold more than {@link Long#MAX_VALUE} tokens throws {@link ArithmeticException}.
 */
public final class DeadlockCheck {
    private static final System.Logger LOG = System.getLogger(DeadlockCheck.class.getName());

    private static final long MAX_FIRST_HUNT = 20_000_000;
    private static final long FIRINGS_PER_TRANSITION = 1_000;
    private static final long LONG_HUNT = 30_000_000;
    private static final int FEW_MARKINGS = 20_000;
    /** Of the first search: roughly markings times the time for each, which grows faster than the transitions. */
    private static final double FEW_STEPS = 16_000_000;

    private static final long MAX_EQUATION_WORK = 1_000_000_000;
    private static final long GUIDED_FIRINGS = 300_000;
    private static final int MAX_COUNT = 1_000_000;

    private final PetriNet net;
    private final SearchLimits limits;
    private final Set<Reduction> reductions;
    private final Function<Set<Reduction>, Reducer.Reduced> reducing;

    private DeadlockCheck(
            PetriNet net,
            Set<Reduction> reductions,
            SearchLimits limits,
            Function<Set<Reduction>, Reducer.Reduced> reducing) {
        this.net = net;
        this.limits = limits;
        this.reductions = reductions;
        this.reducing = reducing;
    }

    /** A rule that makes a net, or its search, smaller and keeps whether it can deadlock. */
    public enum Reduction {
        /** Leaves out transitions that never fire, because nothing puts the tokens that they need. */
        DEAD_TRANSITIONS,
        /** Leaves out places that disable nothing, because they always hold enough tokens. */
        FREE_PLACES,
        /** Leaves out one of two transitions with the same arcs, or one without an effect, if another stands for it. */
        EQUAL_TRANSITIONS,
        /** Fires at once what cannot be prevented from firing. */
        FIRST_STEPS,
        /** Fuses transitions with those before, if they need nothing else. */
        FUSED_AFTER,
        /** Leaves out places that always hold at least as many tokens as some others together. */
        IMPLIED_PLACES,
        /** Keeps the net, but searches one marking of each orbit of a {@link Symmetry}. */
        EQUAL_PARTS
    }

    /** Searches up to {@link ReachabilityGraph#DEFAULT_MAX_MARKINGS} markings of the reduced net. */
    public static Answer<Deadlock> decide(PetriNet net) {
        return decide(net, SearchLimits.markings(ReachabilityGraph.DEFAULT_MAX_MARKINGS));
    }

    /** Searches within {@code limits}, which apply to the last search; cancellation ends all of them. */
    public static Answer<Deadlock> decide(PetriNet net, SearchLimits limits) {
        return decide(net, EnumSet.allOf(Reduction.class), limits);
    }

    /** Searches within {@code limits} with only these {@code reductions}. */
    public static Answer<Deadlock> decide(PetriNet net, Set<Reduction> reductions, SearchLimits limits) {
        return decide(net, reductions, limits, rules -> Reducer.reduce(net, rules, limits.cancelled()));
    }

    /** With another way to apply reductions. */
    static Answer<Deadlock> decide(
            PetriNet net,
            Set<Reduction> reductions,
            SearchLimits limits,
            Function<Set<Reduction>, Reducer.Reduced> reducing) {
        return new DeadlockCheck(net, reductions, limits, reducing).decide();
    }

    private Answer<Deadlock> decide() {
        var cheap = EnumSet.noneOf(Reduction.class);
        cheap.addAll(reductions);
        cheap.remove(Reduction.IMPLIED_PLACES);
        var first = reducing.apply(cheap);
        if (neverDead(first)) {
            return byReduction();
        }
        var size = (long) first.net().transitions().size();
        var found = hunt(first, Math.min(MAX_FIRST_HUNT, (size + FIRINGS_PER_TRANSITION) * size));
        if (found.isPresent()) {
            return found.get();
        }
        var reduced = reductions.equals(cheap) ? first : reducing.apply(reductions);
        if (neverDead(reduced)) {
            return byReduction();
        }
        var symmetry = reductions.contains(Reduction.EQUAL_PARTS)
                ? Symmetry.find(reduced.net())
                : Symmetry.none(reduced.net());
        var most = fewMarkings(reduced.net().transitions().size());
        var few = ofNet(
                reduced,
                DeadlockSearch.run(reduced.net(), symmetry, limits.atMost(most)).answer());
        if (!(few instanceof Answer.Unknown<Deadlock> unknown)
                || unknown.end() != SearchEnd.LIMIT
                || unknown.markings() < most) {
            return few;
        }
        return withoutSearch(reduced)
                .orElseGet(() -> ofNet(reduced, DeadlockSearch.first(reduced.net(), symmetry, limits)));
    }

    private static int fewMarkings(int transitions) {
        return (int) Math.clamp(FEW_STEPS / (transitions * Math.sqrt(transitions)), 1, FEW_MARKINGS);
    }

    /** A proof and hunts that take a second or two. */
    private Optional<Answer<Deadlock>> withoutSearch(Reducer.Reduced reduced) {
        var hint = new HashMap<Transition, Long>();
        var proof = DeadlockEquation.solve(reduced.net(), MAX_EQUATION_WORK, limits.cancelled(), hint::putAll);
        if (proof.isPresent()) {
            return Optional.of(new Answer.Yes<>(
                    "no dead marking of the reduced net satisfies the state equation: "
                            + proof.get().contradictions() + " cases",
                    0));
        }
        return (hint.isEmpty() ? Optional.<Answer<Deadlock>>empty() : guided(reduced, hint))
                .or(() -> hunt(reduced, LONG_HUNT));
    }

    private Optional<Answer<Deadlock>> guided(Reducer.Reduced reduced, Map<Transition, Long> hint) {
        var counts = reduced.net().transitions().stream()
                .mapToInt(t -> Math.clamp(hint.getOrDefault(t, 0L), 0, MAX_COUNT))
                .toArray();
        return new GuidedSearch(reduced.net(), counts, limits.cancelled())
                .run(GUIDED_FIRINGS)
                .map(trace -> canDeadlock(reduced, trace));
    }

    private static Answer<Deadlock> byReduction() {
        return new Answer.Yes<>("reductions leave a transition that needs no tokens", 0);
    }

    private static boolean neverDead(Reducer.Reduced reduced) {
        return reduced.net().transitions().stream()
                .anyMatch(t -> t.inputs().isEmpty() && t.inhibitors().isEmpty());
    }

    private Optional<Answer<Deadlock>> hunt(Reducer.Reduced reduced, long firings) {
        return new CounterexampleHunt(reduced.net(), limits.cancelled())
                .run(firings)
                .map(trace -> canDeadlock(reduced, trace));
    }

    /** What the answer about the reduced net is for the net. */
    private Answer<Deadlock> ofNet(Reducer.Reduced reduced, Answer<Deadlock> ofReduced) {
        return switch (ofReduced) {
            case Answer.No<Deadlock>(var dead) ->
                canDeadlock(
                        reduced,
                        dead.trace().stream().mapToInt(Transition::index).toArray());
            case Answer.Yes<Deadlock>(var proof, var markings) ->
                new Answer.Yes<>("of the reduced net, " + proof, markings);
            case Answer.Unknown<Deadlock> unknown -> unknown;
        };
    }

    /**
     * A dead marking of the net itself. If the trace of the reduced net leads to none, a reduction or its translation
     * is wrong: then the net is searched as it is.
     */
    private Answer<Deadlock> canDeadlock(Reducer.Reduced reduced, int[] trace) {
        var whole = reduced.translate(trace);
        if (!TraceShortener.leadsToDeadMarking(net, whole)) {
            if (reductions.isEmpty()) {
                throw new IllegalStateException(
                        "net " + net.name() + ": a search without reductions ended in a marking that is not dead");
            }
            LOG.log(
                    WARNING,
                    () -> "net " + net.name()
                            + ": a trace of the reduced net leads to no dead marking of the net, which "
                            + "is a fault of the reductions " + reductions + "; the net is searched without them");
            return decide(net, Set.of(), limits);
        }
        var transitions = Arrays.stream(new TraceShortener(net).shorten(whole))
                .mapToObj(net.transitions()::get)
                .toList();
        return new Answer.No<>(new Deadlock(net.fire(net.initialMarking(), transitions), transitions));
    }
}
