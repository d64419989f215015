package io.troupe.petri.deadlock;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import java.util.Arrays;
import java.util.EnumSet;
import java.util.List;
import java.util.Set;

/**
 * Decides whether a net can deadlock: whether it can reach a marking in which no transition may fire. It needs far
 * fewer markings than {@link DeadlockSearch}, but finds one dead marking and not all of them, and its trace is not
 * always a shortest one.
 *
 * <p>The net is reduced first, by rules that keep whether it can deadlock. Then come, from cheap to dear, a short hunt
 * for a counterexample, proofs without a search, a longer hunt, and last all markings of the reduced net by stubborn
 * sets. A trace that was found is translated to the net, and firings that it does not need are left out.
 *
 * {@snippet :
 * var result = DeadlockCheck.decide(net, SearchLimits.markings(1_000_000));
 * assertThat(result).isInstanceOf(DeadlockCheck.Proved.class);
 * }
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> The hunts and proofs have limits of their own, a second or two together for a net of some thousand
 * places. The last search is that of {@link DeadlockSearch#run} on the reduced net.
 *
 * <p><b>Errors.</b> A place that can hold more than {@link Integer#MAX_VALUE} tokens throws
 * {@link ArithmeticException}.
 */
public final class DeadlockCheck {
    private static final long SHORT_HUNT = 3_000_000;
    private static final long LONG_HUNT = 30_000_000;

    private final PetriNet net;
    private final FlatNet flat;
    private final SearchLimits limits;
    private final Reducer.Reduced reduced;
    private final FlatNet small;

    private DeadlockCheck(PetriNet net, Set<Reduction> reductions, SearchLimits limits) {
        this.net = net;
        this.limits = limits;
        flat = FlatNet.of(net);
        reduced = Reducer.reduce(net, reductions, limits.cancelled());
        small = FlatNet.of(reduced.net());
    }

    /** A rule that makes a net smaller and keeps whether it can deadlock. */
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
        /** Fuses transitions with those behind, if they do nothing else. */
        FUSED_BEFORE,
        /** Leaves out places that always hold at least as many tokens as some others together. */
        IMPLIED_PLACES
    }

    /** The result of {@link #decide}. */
    public sealed interface Result {}

    /**
     * The net can deadlock.
     *
     * @param marking a reachable marking in which no transition may fire
     * @param trace a firing sequence that leads there from the initial marking; no single firing can be left out of it
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
     * @param markings how many markings of the reduced net were visited for the proof; 0 without a search
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
     * @param markings how many markings of the reduced net were visited; none of them is dead
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
        return new DeadlockCheck(net, reductions, limits).decide();
    }

    private Result decide() {
        if (neverDead()) {
            return new Proved("a transition needs no tokens", 0);
        }
        var hunt = new CounterexampleHunt(small, limits.cancelled());
        var short1 = hunt.run(SHORT_HUNT);
        if (short1.isPresent()) {
            return canDeadlock(short1.get());
        }
        var long1 = hunt.run(LONG_HUNT);
        if (long1.isPresent()) {
            return canDeadlock(long1.get());
        }
        return search();
    }

    private boolean neverDead() {
        for (var t = 0; t < small.transitions(); t++) {
            if (small.inputs()[t].length == 0 && small.inhibitors()[t].length == 0) {
                return true;
            }
        }
        return false;
    }

    private Result search() {
        var search = DeadlockSearch.run(reduced.net(), limits);
        var dead = search.deadlocks();
        if (!dead.isEmpty()) {
            return canDeadlock(
                    dead.getFirst().trace().stream().mapToInt(Transition::index).toArray());
        }
        return search.end() == SearchEnd.COMPLETE
                ? new Proved("all markings by stubborn sets", search.visitedMarkings())
                : new Unknown(search.end(), search.visitedMarkings());
    }

    private CanDeadlock canDeadlock(int[] trace) {
        var whole = reduced.translate(trace);
        if (!TraceShortener.leadsToDeadMarking(flat, whole)) {
            throw new IllegalStateException(
                    "net " + net.name() + ": the trace of the reduced net leads to no dead marking");
        }
        var transitions = Arrays.stream(new TraceShortener(flat).shorten(whole))
                .mapToObj(net.transitions()::get)
                .toList();
        return new CanDeadlock(net.fire(net.initialMarking(), transitions), transitions);
    }
}
