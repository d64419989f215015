package io.troupe.petri.deadlock;

import static java.lang.System.Logger.Level.WARNING;
import static java.util.Objects.requireNonNull;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.Marking;
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
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;

/**
 * Decides whether a net can deadlock: whether it can reach a marking in which no transition may fire. It needs far
 * fewer markings than {@link DeadlockSearch}, but finds one dead marking and not all of them, and its trace is not
 * always a shortest one.
 *
 * <p>The net is reduced first, by rules that keep whether it can deadlock. Then come, from cheap to dear, a short hunt
 * for a counterexample, a proof without a search, a longer hunt, and last all markings of the reduced net by stubborn
 * sets; of markings that differ only in which of some equal parts is in which state, one ({@link Symmetry}). A trace
 * that was found is translated to the net and fired there, and firings that it does not need are left out. Should it
 * not lead to a dead marking of the net, the net is searched without reductions.
 *
 * {@snippet :
 * var result = DeadlockCheck.decide(net, SearchLimits.markings(1_000_000));
 * assertThat(result).isInstanceOf(DeadlockCheck.Proved.class);
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

    /** The result of {@link #decide}. */
    public sealed interface Result {}

    /**
     * The net can deadlock.
     *
     * @param marking a reachable marking in which no transition may fire
     * @param trace a firing sequence that leads there from the initial marking; no single firing can be left out of it,
     *     unless it has many thousand
     */
    public record CanDeadlock(Marking marking, List<Transition> trace) implements Result {
        public CanDeadlock {
            requireNonNull(marking, "marking");
            trace = List.copyOf(trace);
        }
    }

    /**
     * No reachable marking is dead.
     *
     * @param reason in words
     * @param markings how many markings of the reduced net were visited for the proof, or orbits of these if it has
     *     equal parts; 0 without a search
     */
    public record Proved(String reason, int markings) implements Result {
        public Proved {
            requireNonNull(reason, "reason");
        }
    }

    /**
     * Not known.
     *
     * @param end why the search ended
     * @param markings how many markings of the reduced net, or orbits of these, were visited; none of them is dead
     */
    public record Unknown(SearchEnd end, int markings) implements Result {
        public Unknown {
            requireNonNull(end, "end");
        }
    }

    /** Searches up to {@link ReachabilityGraph#DEFAULT_MAX_MARKINGS} markings of the reduced net. */
    public static Result decide(PetriNet net) {
        return decide(net, SearchLimits.markings(ReachabilityGraph.DEFAULT_MAX_MARKINGS));
    }

    /** Searches within {@code limits}, which apply to the last search; cancellation ends all of them. */
    public static Result decide(PetriNet net, SearchLimits limits) {
        return decide(net, EnumSet.allOf(Reduction.class), limits);
    }

    /** Searches within {@code limits} with only these {@code reductions}. */
    public static Result decide(PetriNet net, Set<Reduction> reductions, SearchLimits limits) {
        return decide(net, reductions, limits, rules -> Reducer.reduce(net, rules, limits.cancelled()));
    }

    /** With another way to apply reductions. */
    static Result decide(
            PetriNet net,
            Set<Reduction> reductions,
            SearchLimits limits,
            Function<Set<Reduction>, Reducer.Reduced> reducing) {
        return new DeadlockCheck(net, reductions, limits, reducing).decide();
    }

    private Result decide() {
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
        var few = search(reduced, symmetry, limits.atMost(most));
        if (!(few instanceof Unknown unknown) || unknown.end() != SearchEnd.LIMIT || unknown.markings() < most) {
            return few;
        }
        return withoutSearch(reduced).orElseGet(() -> searchDepthFirst(reduced, symmetry));
    }

    private static int fewMarkings(int transitions) {
        return (int) Math.clamp(FEW_STEPS / (transitions * Math.sqrt(transitions)), 1, FEW_MARKINGS);
    }

    /** A proof and hunts that take a second or two. */
    private Optional<Result> withoutSearch(Reducer.Reduced reduced) {
        var hint = new HashMap<Transition, Long>();
        var proof = DeadlockEquation.solve(reduced.net(), MAX_EQUATION_WORK, limits.cancelled(), hint::putAll);
        if (proof.isPresent()) {
            return Optional.of(new Proved(
                    "no dead marking of the reduced net satisfies the state equation: "
                            + proof.get().contradictions() + " cases",
                    0));
        }
        return (hint.isEmpty() ? Optional.<Result>empty() : guided(reduced, hint)).or(() -> hunt(reduced, LONG_HUNT));
    }

    private Optional<Result> guided(Reducer.Reduced reduced, Map<Transition, Long> hint) {
        var counts = reduced.net().transitions().stream()
                .mapToInt(t -> Math.clamp(hint.getOrDefault(t, 0L), 0, MAX_COUNT))
                .toArray();
        return new GuidedSearch(reduced.net(), counts, limits.cancelled())
                .run(GUIDED_FIRINGS)
                .map(trace -> canDeadlock(reduced, trace));
    }

    private static Proved byReduction() {
        return new Proved("reductions leave a transition that needs no tokens", 0);
    }

    private static boolean neverDead(Reducer.Reduced reduced) {
        return reduced.net().transitions().stream()
                .anyMatch(t -> t.inputs().isEmpty() && t.inhibitors().isEmpty());
    }

    private Optional<Result> hunt(Reducer.Reduced reduced, long firings) {
        return new CounterexampleHunt(reduced.net(), limits.cancelled())
                .run(firings)
                .map(trace -> canDeadlock(reduced, trace));
    }

    /** The nearest dead marking of the reduced net, if there is one among the first markings. */
    private Result search(Reducer.Reduced reduced, Symmetry symmetry, SearchLimits within) {
        var search = DeadlockSearch.run(reduced.net(), symmetry, within);
        var nearest = search.deadlocks().stream().findFirst();
        return result(reduced, symmetry, nearest, search.end(), search.visitedMarkings());
    }

    private Result searchDepthFirst(Reducer.Reduced reduced, Symmetry symmetry) {
        var search = DeadlockSearch.first(reduced.net(), symmetry, limits);
        return result(reduced, symmetry, search.deadlock(), search.end(), search.visitedMarkings());
    }

    private Result result(
            Reducer.Reduced reduced,
            Symmetry symmetry,
            Optional<DeadlockSearch.Deadlock> dead,
            SearchEnd end,
            int markings) {
        if (dead.isPresent()) {
            var trace = dead.get().trace();
            return canDeadlock(
                    reduced, trace.stream().mapToInt(Transition::index).toArray());
        }
        return end == SearchEnd.COMPLETE
                ? new Proved(
                        symmetry.isTrivial()
                                ? "all markings of the reduced net by stubborn sets"
                                : "all orbits of markings of the reduced net (" + symmetry + ") by stubborn sets",
                        markings)
                : new Unknown(end, markings);
    }

    /**
     * A dead marking of the net itself. If the trace of the reduced net leads to none, a reduction or its translation
     * is wrong: then the net is searched as it is.
     */
    private Result canDeadlock(Reducer.Reduced reduced, int[] trace) {
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
        return new CanDeadlock(net.fire(net.initialMarking(), transitions), transitions);
    }
}
