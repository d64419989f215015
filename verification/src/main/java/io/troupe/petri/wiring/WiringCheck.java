package io.troupe.petri.wiring;

import io.troupe.petri.Answer;
import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Symmetry;
import io.troupe.petri.Transition;
import io.troupe.petri.deadlock.DeadlockCheck;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Collectors;

/**
 * Checks whether the components of a {@link Wiring} can come to wait for each other for ever.
 *
 * <p>The nets of the components are melded, first of every two that call each other, then of all. A pair is searched in
 * full. In the whole, a search by stubborn sets finds all dead markings, with a shortest trace to each, among a small
 * part of the markings. If the net is too large for that, {@link DeadlockCheck} finds one of them, or proves that there
 * is none. If there are none, another search decides whether some components can be blocked while others go on; if it
 * is too large and components are equal, one marking is searched of each orbit of a {@link Symmetry}. The full graph,
 * within the limit, adds its figures and how a block begins, and decides what the other searches could not. The result
 * reports what was beyond all limits. In a unit test:
 *
 * {@snippet :
 * @Test
 * void components_neverDeadlock() {
 *     var wiring = Wiring.of("demo").component(client()).component(planner()).build();
 *     assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved.class);
 * }
 * }
 *
 * If this fails, its message is the counterexample of the deadlock.
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> That of {@link DeadlockSearch#run}, {@link ProgressSearch#run} and {@link ReachabilityGraph#explore},
 * for each pair (those with the same net once), the whole, and the repaired whole. The markings of the whole grow
 * exponentially with the number of components. Once the verdict is known, the full graph ends at 300,000 markings.
 *
 * <p><b>Errors.</b> A limit below 1, and a wiring whose {@link Wiring#withSynchronisedStop synchronised stop} has more
 * than 1000 combinations of states, throw {@link IllegalArgumentException}.
 *
 * <p><b>Source.</b> Sections 5.5 and 5.6 of the paper.
 */
public final class WiringCheck {
    /** The limit of {@link #check(Wiring)}: a second or two for each search, and some 100 MiB. */
    public static final int DEFAULT_MAX_MARKINGS = 500_000;

    /**
     * The limit once the verdict is known: the full graph then only adds figures and causes, which are not worth more
     * than a second.
     */
    private static final int MAX_MARKINGS_IF_KNOWN = 300_000;

    /** Markings times places and transitions: the searches of a large net visit fewer markings in the same time. */
    private static final long DEFAULT_WORK = 100_000_000;

    /** The most for a search that others follow if it is not complete. */
    private static final long QUICK_WORK = DEFAULT_WORK / 10;

    /** With so many equal components an orbit has up to some ten thousand markings. */
    private static final int MANY_EQUAL = 8;

    private static final int MIN_MARKINGS = 1_000;

    private final Wiring wiring;
    private final WiringNet net;
    private final SearchLimits limits;
    private final long work;
    private final long quickWork;

    /**
     * Creates the check of one wiring.
     *
     * @param work how many markings times places and transitions each search may visit; the first ones a tenth of it
     */
    WiringCheck(Wiring wiring, SearchLimits limits, long work) {
        this.wiring = wiring;
        this.limits = limits;
        this.work = work;
        quickWork = Math.min(work / 10, QUICK_WORK);
        net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
    }

    /**
     * Visits up to {@link #DEFAULT_MAX_MARKINGS} markings in each search, and fewer if the net has more than 200 places
     * and transitions.
     */
    public static WiringResult check(Wiring wiring) {
        return new WiringCheck(wiring, SearchLimits.markings(DEFAULT_MAX_MARKINGS), DEFAULT_WORK).result();
    }

    /** Visits up to {@code maxMarkings} (1 or more) markings in each search. */
    public static WiringResult check(Wiring wiring, int maxMarkings) {
        return check(wiring, SearchLimits.markings(maxMarkings));
    }

    /**
     * Searches within {@code limits}; they apply to each search, and each search reports its progress separately. Once
     * cancelled, the result contains what was found until then.
     */
    public static WiringResult check(Wiring wiring, SearchLimits limits) {
        return new WiringCheck(wiring, limits, Long.MAX_VALUE).result();
    }

    /**
     * What is known about dead markings.
     *
     * @param nearest all dead markings, or the nearest ones
     * @param found one dead marking of a large net
     */
    private record Deadlocks(
            ReducedFigures figures, List<DeadlockSearch.Deadlock> nearest, Optional<DeadlockSearch.Deadlock> found) {
        static Deadlocks of(DeadlockSearch search) {
            return new Deadlocks(ReducedFigures.of(search), search.deadlocks(), Optional.empty());
        }

        boolean isEmpty() {
            return nearest.isEmpty() && found.isEmpty();
        }

        boolean mayBeFree() {
            return isEmpty() && figures.isComplete();
        }
    }

    WiringResult result() {
        var pairs = new PairCheck(wiring, limits).results();
        var dead = deadlocks();
        var progress = dead.isEmpty() ? progress(dead.mayBeFree()) : Progress.UNKNOWN;
        var settled = progress.search();
        var byOrbits = progress.byOrbits();
        var isKnown = settled.isPresent() || byOrbits.isPresent() || !dead.isEmpty();
        var graph = ReachabilityGraph.explore(
                net.net(),
                isKnown ? affordable(limits.atMost(MAX_MARKINGS_IF_KNOWN), DEFAULT_WORK) : affordable(limits, work));
        var whole = new WiringSearch(wiring, net, graph);
        var figures = whole.figures();
        var reduced = settled.map(ReducedFigures::of)
                .or(() -> byOrbits.map(OrbitCheck.Result::figures))
                .orElse(dead.figures());
        var deadlocks = dead.found()
                .map(each -> List.of(whole.deadlock(each)))
                .orElseGet(() -> dead.isEmpty() ? whole.deadlocks() : whole.deadlocks(dead.nearest()));
        var blocks = figures.isComplete()
                ? whole.blocks()
                : settled.map(found -> whole.blocks(found.losses()))
                        .or(() -> byOrbits.map(OrbitCheck.Result::blocks))
                        .orElse(List.of());
        if (!deadlocks.isEmpty()) {
            return new WiringResult.Deadlock(figures, reduced, pairs, deadlocks, blocks, repair());
        }
        if (!blocks.isEmpty()) {
            return new WiringResult.Blocked(figures, reduced, pairs, blocks, repair());
        }
        if (figures.isComplete() || settled.isPresent() || byOrbits.isPresent()) {
            return new WiringResult.Proved(figures, reduced, pairs);
        }
        return reduced.isComplete()
                ? new WiringResult.DeadlockFree(figures, reduced, pairs)
                : new WiringResult.Unknown(figures, reduced, pairs);
    }

    /**
     * All dead markings with shortest traces, if the net is small or they are near. Otherwise one of them, or a proof
     * that there is none.
     */
    private Deadlocks deadlocks() {
        var first = DeadlockSearch.run(net.net(), affordable(limits, quickWork));
        if (first.end() == SearchEnd.COMPLETE || first.end() == SearchEnd.CANCELLED) {
            return Deadlocks.of(first);
        }
        if (!first.deadlocks().isEmpty()) {
            return Deadlocks.of(DeadlockSearch.run(net.net(), affordable(limits, work)));
        }
        return switch (DeadlockCheck.decide(net.net(), affordable(limits, work))) {
            case Answer.No<DeadlockSearch.Deadlock>(var found) ->
                new Deadlocks(ReducedFigures.of(found), List.of(), Optional.of(found));
            case Answer.Yes<DeadlockSearch.Deadlock>(var proof, var markings) ->
                new Deadlocks(ReducedFigures.ofProof(markings), List.of(), Optional.empty());
            case Answer.Unknown<DeadlockSearch.Deadlock> unknown -> Deadlocks.of(first);
        };
    }

    /** The complete search that decides whether every component can always go on; one of the two, or none. */
    private record Progress(Optional<ProgressSearch> search, Optional<OrbitCheck.Result> byOrbits) {
        static final Progress UNKNOWN = new Progress(Optional.empty(), Optional.empty());
    }

    /** Both searches are tried with little work first, since either may be much smaller than the other. */
    private Progress progress(boolean mayBeFree) {
        var found = bySearch(mayBeFree, quickWork);
        if (found.isPresent()) {
            return found.get();
        }
        var symmetry = Symmetry.find(net.net());
        var hasManyEqual =
                symmetry.groups().stream().anyMatch(group -> group.blocks().size() >= MANY_EQUAL);
        return byOrbits(symmetry, quickWork)
                .or(() -> hasManyEqual ? byOrbits(symmetry, work) : bySearch(mayBeFree, work))
                .or(() -> hasManyEqual ? bySearch(mayBeFree, work) : byOrbits(symmetry, work))
                .orElse(Progress.UNKNOWN);
    }

    private Optional<Progress> bySearch(boolean mayBeFree, long most) {
        if (!mayBeFree) {
            return Optional.empty();
        }
        var search = ProgressSearch.run(net.net(), affordable(limits, most));
        return search.end() == SearchEnd.COMPLETE
                ? Optional.of(new Progress(Optional.of(search), Optional.empty()))
                : Optional.empty();
    }

    private Optional<Progress> byOrbits(Symmetry symmetry, long most) {
        return new OrbitCheck(wiring, net, symmetry, affordable(limits, most))
                .result()
                .map(found -> new Progress(Optional.empty(), Optional.of(found)));
    }

    /** The limits, and at most so many markings that visiting them costs about {@code most} steps. */
    private SearchLimits affordable(SearchLimits given, long most) {
        var cost = 1L + net.net().places().size() + net.net().transitions().size();
        return given.atMost(Math.clamp(most / cost, MIN_MARKINGS, Integer.MAX_VALUE));
    }

    private Optional<Repair> repair() {
        var together = wiring.withSynchronisedStop();
        var stops = new LinkedHashMap<String, List<String>>();
        for (var component : wiring.components()) {
            var states = together.stops(component);
            if (!states.isEmpty()) {
                stops.put(component, states);
            }
        }
        if (wiring.stopsTogether() || stops.isEmpty() || !SynchronisedStop.isFeasible(together)) {
            return Optional.empty();
        }
        return Optional.of(new Repair(together, stops, new WiringCheck(together, limits, work).result()));
    }

    /**
     * Decides whether every component can always go on, by one marking of each orbit. A component stays where it is,
     * and the others equal to it are exchanged; what is found for it holds for these too.
     */
    static final class OrbitCheck {
        private final Wiring wiring;
        private final WiringNet net;
        private final Symmetry symmetry;
        private final SearchLimits limits;

        OrbitCheck(Wiring wiring, WiringNet net, Symmetry symmetry, SearchLimits limits) {
            this.wiring = wiring;
            this.net = net;
            this.symmetry = symmetry;
            this.limits = limits;
        }

        /** What was found in complete searches without dead markings. */
        record Result(ReducedFigures figures, List<Counterexample> blocks) {}

        /** Empty if there are no equal components, or too many orbits, or a dead marking. */
        Optional<Result> result() {
            var blocks = new ArrayList<Counterexample>();
            var largest = Optional.<ReachabilityGraph>empty();
            for (var component : symmetry.isTrivial() ? List.<String>of() : different()) {
                var left = leaving(component);
                var graph = ReachabilityGraph.explore(net.net(), left, limits);
                if (!graph.isComplete() || !graph.dead().isEmpty() || !left.keeps(steps(component))) {
                    return Optional.empty();
                }
                new WiringSearch(wiring, net, graph).block(component).ifPresent(blocks::add);
                largest = largest.filter(most -> most.size() >= graph.size()).or(() -> Optional.of(graph));
            }
            return largest.map(graph -> new Result(ReducedFigures.of(graph, symmetry), blocks));
        }

        /** Components such that every other one is equal to one of them. */
        private List<String> different() {
            var different = new ArrayList<String>();
            for (var component : wiring.components()) {
                var steps = steps(component);
                if (different.stream().noneMatch(other -> symmetry.exchanges(steps(other), steps))) {
                    different.add(component);
                }
            }
            return different;
        }

        private Set<Transition> steps(String component) {
            return net.net().transitions().stream()
                    .filter(t -> net.event(t).who().contains(component))
                    .collect(Collectors.toSet());
        }

        /** The symmetry that leaves a component where it is. */
        private Symmetry leaving(String component) {
            var left = symmetry;
            for (var place : net.net().places()) {
                if (net.owner(place).filter(component::equals).isPresent()) {
                    left = left.fixing(place);
                }
            }
            return left;
        }
    }

    /**
     * Checks every two components that call each other separately from the rest. Of several pairs with the same net
     * only one is searched.
     */
    static final class PairCheck {
        private final Wiring wiring;
        private final SearchLimits limits;
        private final Map<List<List<Integer>>, ReachabilityGraph> searched = new HashMap<>();

        PairCheck(Wiring wiring, SearchLimits limits) {
            this.wiring = wiring;
            this.limits = limits;
        }

        List<PairResult> results() {
            var results = new ArrayList<PairResult>();
            var components = wiring.components();
            for (var i = 0; i < components.size(); i++) {
                for (var other : components.subList(i + 1, components.size())) {
                    var one = components.get(i);
                    if (calls(one, other) || calls(other, one)) {
                        results.add(result(one, other));
                    }
                }
            }
            return List.copyOf(results);
        }

        /** The number of nets that were searched. */
        int searched() {
            return searched.size();
        }

        private boolean calls(String caller, String provider) {
            return wiring.protocol(caller)
                    .outgoing()
                    .anyMatch(step -> wiring.provider(caller, step).equals(provider));
        }

        private PairResult result(String one, String other) {
            var net = new WiringNet(wiring, new LinkedHashSet<>(List.of(one, other)));
            var graph = searched.computeIfAbsent(net.shape(), shape -> ReachabilityGraph.explore(net.net(), limits));
            var search = new WiringSearch(wiring, net, graph);
            var deadlocks = search.deadlocks();
            return new PairResult(one, other, search.figures(), deadlocks.isEmpty() ? search.blocks() : deadlocks);
        }
    }
}
