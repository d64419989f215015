package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalStateException;

import com.sun.management.ThreadMXBean;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.tools.Thorough;
import java.lang.management.ManagementFactory;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * The search of all markings, whole or ended by its limits, by its caller or for want of memory, and the searches by
 * stubborn sets: {@link ReachabilityGraph}, {@link DeadlockSearch} and {@link ProgressSearch}.
 */
class SearchTest {
    private static final PetriNet COUNTER = net("counter", "n", "up: > n");
    private static final SearchLimits LIMITS = SearchLimits.markings(10_000);
    private static final SearchLimits WIDE = SearchLimits.markings(100_000);

    /** n tokens that move one by one from a to b: n + 1 markings in a row. */
    private static PetriNet hourglass(int n) {
        return net("hourglass", "a=" + n + " b", "fall: a > b");
    }

    @Test
    void tokens_beyondOneBitPerPlace_areCountedExactly() {
        for (var n : List.of(1, 2, 3, 4, 15, 16, 255, 256, 70_000)) {
            var graph = ReachabilityGraph.explore(hourglass(n));
            assertThat(List.of(graph.size(), graph.edgeCount(), (int) graph.mostTokens()))
                    .containsExactly(n + 1, n, n);
            assertThat(graph.dead()).singleElement().satisfies(state -> {
                assertThat(state.marking().tokens(graph.net().place("b"))).isEqualTo((long) n);
                assertThat(state.shortestTrace()).hasSize(n);
            });
        }
    }

    @Test
    void store_widenedOnTheWay_keepsWhatItFound() {
        var graph = ReachabilityGraph.explore(COUNTER, 1000);
        for (var state : graph.states()) {
            assertThat(state.marking().tokens(COUNTER.place("n"))).isEqualTo(state.index());
            assertThat(graph.find(state.marking())).contains(state);
        }
    }

    @Test
    void exploration_stoppedAtLimit_saysWhatIsKnownAndWhatIsNot() {
        var graph = ReachabilityGraph.explore(COUNTER, 100);
        assertThat(graph.isComplete()).isFalse();
        assertThat(graph.size()).isEqualTo(100);
        assertThat(graph.openCount()).isEqualTo(1);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(graph.summary()).isEqualTo("""
            counter: stopped at the limit of 100 markings; 1 of them have successors beyond it, which were not visited
              dead markings so far: 0; whether there are others is not known
              most tokens on a place so far: 99
              places never marked so far: []
              transitions never enabled so far: []\
            """);
        assertThat(graph.states().get(99).successors()).isEmpty();
        assertThat(graph.dead()).isEmpty();
    }

    @Test
    void exploration_limitThatFits_isComplete() {
        assertThat(ReachabilityGraph.explore(hourglass(9), 10).deadlockFree()).isEqualTo(Verdict.NO);
        assertThat(ReachabilityGraph.explore(hourglass(9), 10).isComplete()).isTrue();
        assertThat(ReachabilityGraph.explore(hourglass(9), 9).isComplete()).isFalse();
    }

    @Test
    void limits_outOfRange_areRefused() {
        refused(() -> ReachabilityGraph.explore(COUNTER, 0), "maxMarkings is 0, expected 1 or more");
        refused(() -> LIMITS.reporting(0, progress -> {}), "markingsPerReport is 0, expected 1 or more");
        refused(() -> LIMITS.within(0), "maxBytes is 0, expected 1 or more");
    }

    @Test
    void exploration_deadMarkingBelowLimit_isReportedThoughIncomplete() {
        var net = net("counter", "n idle=1 crashed", "up: > n", "crash: idle 2*n > crashed n");
        var mayStop = net("mayStop", "on=1 off n", "up: on > on n", "stop: on > off");
        assertThat(ReachabilityGraph.explore(net, 50).deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        var graph = ReachabilityGraph.explore(mayStop, 50);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.NO);
        assertThat(graph.isComplete()).isFalse();
        assertThat(graph.dead().get(0)).hasToString("{off}");
        assertThat(graph.dead().get(0).shortestTrace()).containsExactly(mayStop.transition("stop"));
    }

    @Test
    void deadPartsOfNet_areNamed() {
        var net = net("stuck", "a=1 b c", "ab: a > b", "bc: b a > c");
        var graph = ReachabilityGraph.explore(net);
        assertThat(graph.neverMarked()).containsExactly(net.place("c"));
        assertThat(graph.neverFired()).containsExactly(net.transition("bc"));
        assertThat(graph.mostTokens(net.place("b"))).isEqualTo(1);
        assertThat(graph.find(net.marking("c"))).isEmpty();
        assertThat(graph.find(net.marking("b", "b"))).isEmpty();
        assertThat(graph.summary()).isEqualTo("""
            stuck: 2 markings, 1 edges, all of them
              dead markings: 1, the nearest {b} after [ab]
              most tokens on a place: 1
              places never marked: [c]
              transitions never enabled: [bc]\
            """);
    }

    @Test
    void net_withoutPlacesOrTransitions_hasOneDeadMarking() {
        assertThat(ReachabilityGraph.explore(net("nothing", "")).dead()).hasSize(1);
    }

    @Test
    void report_isCalledAfterEachStepWithGrowingNumbers() {
        var reports = new ArrayList<SearchProgress>();
        var graph = ReachabilityGraph.explore(PaperNets.uncorrected(Reading.A), LIMITS.reporting(500, reports::add));
        assertThat(reports).extracting(SearchProgress::expanded).containsExactly(500, 1000);
        assertThat(reports)
                .isSortedAccordingTo(Comparator.comparingInt(SearchProgress::markings))
                .allMatch(progress -> progress.markings() > progress.expanded()
                        && progress.edges() > progress.expanded()
                        && progress.dead() <= 6);
        assertThat(graph.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThatIllegalStateException()
                .isThrownBy(() -> ReachabilityGraph.explore(graph.net(), LIMITS.reporting(10, progress -> {
                    throw new IllegalStateException("no more at " + progress.expanded());
                })))
                .withMessage("no more at 10");
    }

    @Test
    void search_cancelledOnTheWay_tellsOnlyWhatItSaw() {
        var net = PaperNets.uncorrected(Reading.A);
        var cancel = new AtomicBoolean();
        var whole = ReachabilityGraph.explore(net);

        var part = ReachabilityGraph.explore(
                net, LIMITS.cancelledBy(cancel::get).reporting(50, progress -> cancel.set(true)));

        assertThat(part.end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(part.isComplete()).isFalse();
        assertThat(part.size()).isBetween(51, 1263);
        assertThat(part.openCount()).isEqualTo(part.size() - 50);
        assertThat(part.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(part.safe()).isEqualTo(Verdict.UNKNOWN);
        assertThat(part.summary())
                .startsWith("uncorrected A: cancelled at " + part.size() + " markings; " + part.openCount()
                        + " of them may have successors that were not visited\n");
        for (var state : part.states()) {
            var same = whole.find(state.marking()).orElseThrow();
            assertThat(state.shortestTrace()).isEqualTo(same.shortestTrace());
            assertThat(state.isOpen()).isEqualTo(state.index() >= 50);
            var successors = state.isOpen() ? 0 : same.successors().size();
            assertThat(state.successors()).hasSize(successors);
            assertThat(state.marking().marked()).allMatch(place -> part.mostTokens(place) == 1);
        }
        assertThat(Liveness.of(part).terminalComponents()).isEmpty();
        assertThat(Liveness.of(part).live()).isEqualTo(Verdict.UNKNOWN);
    }

    @Test
    void search_cancelledBeforeItStarts_knowsTheInitialMarkingOnly() {
        var net = PaperNets.corrected(Reading.A);
        var graph = ReachabilityGraph.explore(net, LIMITS.cancelledBy(() -> true));
        assertThat(graph.states()).extracting(ReachabilityGraph.State::marking).containsExactly(net.initialMarking());
        assertThat(graph.mostTokens(net.place("R1"))).isEqualTo(1);
        assertThat(graph.end()).isEqualTo(SearchEnd.CANCELLED);
    }

    @Test
    void search_atItsLimitOfMemory_tellsWhatItKnows() {
        var net = net("unbounded", "a=1 many", "t: a > a many");
        var limits = SearchLimits.markings(Integer.MAX_VALUE).within(4 << 20);
        var graph = ReachabilityGraph.explore(net, limits);
        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isGreaterThan(1000);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(graph.openCount()).isPositive();
        assertThat(graph.states().getLast().isOpen()).isTrue();
        assertThat(graph.summary()).startsWith("unbounded: out of memory at " + graph.size() + " markings; ");
        assertThat(Liveness.of(graph).live()).isEqualTo(Verdict.UNKNOWN);
        assertThat(DeadlockSearch.run(net, limits).toString()).endsWith("0 dead so far; out of memory");
    }

    /** Simulates a virtual machine without memory; the markings found so far are kept. */
    @Test
    void outOfMemoryError_endsTheSearchWithWhatItHas() {
        var net = Nets.switches(10);
        Chooser failing = new Chooser() {
            private int asked;

            @Override
            public int choose(TokenGame game, int[] chosen) {
                if (++asked == 100) {
                    throw new OutOfMemoryError("Java heap space");
                }
                return ALL.choose(game, chosen);
            }
        };

        var graph = ReachabilityGraph.explore(net, failing, LIMITS);

        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isGreaterThan(100);
        assertThat(graph.openCount()).isEqualTo(graph.size() - 99);
        assertThat(graph.states().get(98).successors()).isNotEmpty();
        assertThat(graph.states().get(99).successors()).isEmpty();
        assertThat(Liveness.of(graph).reversible()).isEqualTo(Verdict.UNKNOWN);
    }

    /** Random nets with weights, priorities and up to 90 places against a plain search over {@link PetriNet#fire}. */
    @Test
    void graph_ofRandomNets_agreesWithPlainSearch() {
        for (var seed = 1L; seed <= Thorough.times(30, 150); seed++) {
            var as = "seed " + seed;
            var net = randomNet(new Random(seed));
            var limit = 150;
            var distances = plainSearch(net, limit + 1);
            var graph = ReachabilityGraph.explore(net, limit);

            assertThat(graph.isComplete()).as(as).isEqualTo(distances.size() <= limit);
            if (graph.isComplete()) {
                assertThat(graph.size()).as(as).isEqualTo(distances.size());
            }
            var fired = new HashSet<Transition>();
            var dead = new ArrayList<ReachabilityGraph.State>();
            for (var state : graph.states()) {
                var marking = state.marking();
                var trace = state.shortestTrace();
                assertThat(net.fire(net.initialMarking(), trace)).as(as).isEqualTo(marking);
                assertThat(trace).as(as).hasSize(distances.get(marking));
                var enabled = net.enabled(marking);
                fired.addAll(enabled);
                if (enabled.isEmpty()) {
                    dead.add(state);
                }
                var edges = state.successors();
                edges.forEach(edge -> assertThat(net.fire(marking, edge.transition()))
                        .as(as)
                        .isEqualTo(edge.target().marking()));
                if (graph.isComplete()) {
                    assertThat(edges)
                            .as(as)
                            .extracting(ReachabilityGraph.Edge::transition)
                            .isEqualTo(enabled);
                }
            }
            assertThat(graph.dead()).as(as).isEqualTo(dead);
            var neverFired = new ArrayList<>(net.transitions());
            neverFired.removeAll(fired);
            assertThat(graph.neverFired()).as(as).isEqualTo(neverFired);
        }
    }

    private static PetriNet randomNet(Random random) {
        var net = PetriNet.builder("random");
        var places = random.nextInt(10) == 0 ? 90 : 2 + random.nextInt(6);
        for (var p = 0; p < places; p++) {
            net.place("p" + p, random.nextInt(4) == 0 ? random.nextInt(5) : 0);
        }
        var transitions = 1 + random.nextInt(6);
        for (var t = 0; t < transitions; t++) {
            net.transition("t" + t).priority("t" + t, random.nextInt(5) == 0 ? 1 : 0);
            for (var p = 0; p < places; p++) {
                if (random.nextInt(Math.min(places, 8)) == 0) {
                    net.arc("p" + p, "t" + t, 1 + random.nextInt(2));
                }
                if (random.nextInt(Math.min(places, 8)) == 0) {
                    net.arc("t" + t, "p" + p, 1 + random.nextInt(2));
                }
            }
        }
        return net.build();
    }

    /** Up to {@code limit} markings with their distances from the initial one. */
    private static Map<Marking, Integer> plainSearch(PetriNet net, int limit) {
        var distances = new HashMap<>(Map.of(net.initialMarking(), 0));
        var queue = new ArrayDeque<>(List.of(net.initialMarking()));
        while (!queue.isEmpty()) {
            var marking = queue.remove();
            for (var transition : net.enabled(marking)) {
                var next = net.fire(marking, transition);
                if (distances.size() < limit && distances.putIfAbsent(next, distances.get(marking) + 1) == null) {
                    queue.add(next);
                }
            }
        }
        return distances;
    }

    // ---- searches by stubborn sets

    private static List<Marking> deadMarkings(ReachabilityGraph graph) {
        return graph.dead().stream().map(ReachabilityGraph.State::marking).toList();
    }

    /** Circles of {@code length} places, each with a token that moves round independently. */
    private static PetriNet circles(int count, int length) {
        var net = PetriNet.builder("circles");
        for (var c = 0; c < count; c++) {
            for (var i = 0; i < length; i++) {
                net.place("p" + c + "." + i, i == 0 ? 1 : 0);
            }
            for (var i = 0; i < length; i++) {
                var next = "p" + c + "." + (i + 1) % length;
                net.transition("t" + c + "." + i, List.of("p" + c + "." + i), List.of(next));
            }
        }
        return net.build();
    }

    private static long allocated(Runnable work) {
        var threads = (ThreadMXBean) ManagementFactory.getThreadMXBean();
        var before = threads.getCurrentThreadAllocatedBytes();
        work.run();
        return threads.getCurrentThreadAllocatedBytes() - before;
    }

    @ParameterizedTest
    @CsvSource({"A, 6, 200", "B, 3, 200"})
    void uncorrectedNet_allDeadMarkingsAreFoundInAFractionOfTheGraph(Reading reading, int dead, int atMost) {
        var net = PaperNets.uncorrected(reading);
        var search = DeadlockSearch.run(net);
        assertThat(search.deadlocks())
                .hasSize(dead)
                .extracting(DeadlockSearch.Deadlock::marking)
                .containsExactlyInAnyOrderElementsOf(deadMarkings(ReachabilityGraph.explore(net)));
        assertThat(search.visitedMarkings()).isLessThan(atMost);
        var corrected = DeadlockSearch.run(PaperNets.corrected(reading));
        assertThat(corrected.deadlockFree()).isEqualTo(Verdict.YES);
    }

    @Test
    void stops_ofLowerPriority_areSearchedInFull() {
        var search = DeadlockSearch.run(PaperNets.lowPriorityStops(Reading.A));
        assertThat(search.deadlockFree()).isEqualTo(Verdict.YES);
        assertThat(search.visitedMarkings()).isEqualTo(360);
        assertThat(search.visitedEdges()).isEqualTo(891);
    }

    /** 2^40 markings, of which one order of firings is enough. */
    @Test
    void independentSteps_areTakenInOneOrder() {
        var search = DeadlockSearch.run(Nets.switches(40));
        assertThat(search.visitedMarkings()).isEqualTo(41);
        assertThat(search.deadlocks())
                .singleElement()
                .satisfies(dead -> assertThat(dead.trace()).hasSize(40));
    }

    @Test
    void deadlockSearch_tellsTheNearest_andThatItEndedEarly() {
        var net = PaperNets.uncorrected(Reading.A);
        var stop = new AtomicBoolean();
        var limits = SearchLimits.markings(1000).cancelledBy(stop::get).reporting(5, progress -> stop.set(true));
        var limited = DeadlockSearch.run(net, SearchLimits.markings(10));
        var cancelled = DeadlockSearch.run(net, limits);
        assertThat(DeadlockSearch.run(net("end", "a=1 b", "go: a > b"))).hasToString("""
            end: 2 markings visited, 1 dead, all of them
              the nearest {b} after [go]\
            """);
        assertThat(limited.end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(limited.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(limited).hasToString("uncorrected A: 10 markings visited, 0 dead so far; stopped at the limit");
        assertThat(cancelled.end()).isEqualTo(SearchEnd.CANCELLED);
        assertThat(cancelled.toString()).endsWith(" so far; cancelled");
    }

    /** With two priorities stubborn sets follow all transitions, so that both searches visit the same markings. */
    @Test
    void deadlockSearch_keepsNoEdges() {
        var net = Nets.switches(14).toBuilder()
                .place("key")
                .transition("last", List.of("key"), List.of())
                .priority("last", 1)
                .build();
        var limits = SearchLimits.markings(1 << 20).within(1 << 20);
        var search = DeadlockSearch.run(net, limits);
        var graph = ReachabilityGraph.explore(net, limits);
        assertThat(search.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(search.visitedMarkings()).isEqualTo(1 << 14);
        assertThat(search.visitedEdges()).isEqualTo(14 << 13);
        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isLessThan(1 << 14);
    }

    /** 2^17 markings with 17 x 2^16 edges, which alone would take 68 bytes for each marking. */
    @Test
    void exploration_withoutEdges_takesAtMost40BytesForEachMarkingBesideItself() {
        var net = Nets.switches(17);
        var markings = 1 << 17;
        var words = 1; // 34 places, one bit each
        var graph = ReachabilityGraph.exploreMarkings(
                net, SearchLimits.markings(markings).within(markings * (words * 8L + 40)));
        assertThat(graph.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(List.of(graph.size(), graph.edgeCount())).containsExactly(markings, 17 << 16);
        var whole = ReachabilityGraph.explore(net);
        for (var index : List.of(0, 1, 77, markings - 1)) {
            assertThat(graph.state(index).successors())
                    .hasToString(whole.state(index).successors().toString());
        }
        refused(
                () -> Liveness.of(graph),
                "the graph of net switches has no edges, expected one made by ReachabilityGraph.explore");
    }

    /** The same limit for the searches for dead markings, of a net of which stubborn sets leave out nothing. */
    @Test
    void searches_withoutEdges_takeAtMost40BytesForEachMarkingBesideItself() {
        var toggles = Nets.switches(17).toBuilder().place("key").transition("last", List.of("key"), List.of());
        for (var i = 0; i < 17; i++) {
            toggles.transition("back" + i, List.of("on" + i), List.of("off" + i));
        }
        var net = toggles.priority("last", 1).build();
        var markings = 1 << 17;
        var chunks = 3 << 18; // the last one of each of three lists is not full
        var limits = SearchLimits.markings(markings).within(markings * (8L + 40) + chunks);
        var search = DeadlockSearch.run(net, limits);
        var first = DeadlockSearch.first(net, limits);
        var all = new Answer.Yes<DeadlockSearch.Deadlock>("all markings by stubborn sets", markings);
        assertThat(List.of(search.answer(), first)).containsOnly(all);
        assertThat(search.bytesPerMarking()).isEqualTo(8);
        assertThat(DeadlockSearch.first(net, limits.within(markings * (8L + 20) + chunks)))
                .isInstanceOfSatisfying(
                        Answer.Unknown.class,
                        unknown -> assertThat(unknown.end()).isEqualTo(SearchEnd.MEMORY));
    }

    @Test
    void deadlocks_areMadeWhenTheyAreAskedFor() {
        var search = DeadlockSearch.run(Nets.choices(12));
        var dead = search.deadlocks();
        assertThat(dead).hasSize(1 << 12);
        // 4,096 traces of 12 firings would take more than 300 kB
        assertThat(allocated(() -> assertThat(search.deadlocks().size()).isPositive()))
                .isLessThan(20_000);
        assertThat(dead.get(4095).trace()).hasSize(12);
    }

    /** A row of places. Comparing all pairs of 2,000 transitions would need 4,000,000 pairs and hundreds of MiB. */
    @Test
    void stubbornSets_ofALargeNet_areMadeFromItsArcs() {
        var row = PetriNet.builder("row").place("p0", 1);
        for (var i = 1; i <= 2000; i++) {
            row.place("p" + i).transition("t" + i, List.of("p" + (i - 1)), List.of("p" + i));
        }
        var net = row.build();
        assertThat(allocated(() -> new StubbornSets(net))).isLessThan(20 << 20);
        assertThat(DeadlockSearch.run(net).visitedMarkings()).isEqualTo(2001);
    }

    @Test
    void circles_thatIgnoreEachOther_areOpenedUntilAllTransitionsAreLive() {
        var net = circles(3, 4);
        assertThat(DeadlockSearch.run(net).visitedMarkings()).isEqualTo(4);
        var search = ProgressSearch.run(net, WIDE);
        assertThat(search.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(search.losses()).isEmpty();
        assertThat(net.transitions()).allMatch(t -> search.live(t) == Verdict.YES);
        assertThat(search.toString()).endsWith("all transitions are live");
    }

    @Test
    void lossBesideACircle_isFound() {
        var onAndOff = net("switch", "on=1 off", "work: on > on", "stop: on > off");
        var net = circles(1, 3).toBuilder().add(onAndOff).build();
        var search = ProgressSearch.run(net, WIDE);
        assertThat(search.losses()).singleElement().satisfies(loss -> {
            assertThat(loss.lost()).extracting(Transition::name).containsExactlyInAnyOrder("work", "stop");
            assertThat(net.fire(net.initialMarking(), loss.trace())).isEqualTo(loss.marking());
        });
        assertThat(search.live(net.transition("work"))).isEqualTo(Verdict.NO);
        assertThat(search.live(net.transition("t0.0"))).isEqualTo(Verdict.YES);
    }

    @Test
    void progressSearch_thatEndsEarly_knowsNothing() {
        var net = PaperNets.corrected(Reading.A);
        var search = ProgressSearch.run(net, SearchLimits.markings(10));
        var cancelled = ProgressSearch.run(net, WIDE.cancelledBy(() -> true));
        assertThat(search.end()).isEqualTo(SearchEnd.LIMIT);
        assertThat(search.live(net.transition("Tstop"))).isEqualTo(Verdict.UNKNOWN);
        assertThat(search).hasToString("corrected A: 10 markings visited, stopped at the limit");
        assertThat(cancelled.end()).isEqualTo(SearchEnd.CANCELLED);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2, 3, 6})
    void teams_areLiveIfTheyStopTogether_otherwiseLoseTheRegistrationOnly(int robots) {
        var together = ProgressSearch.run(RobotTeams.stoppingTogether(robots), WIDE);
        var oneByOne = ProgressSearch.run(RobotTeams.stoppingOneByOne(robots), WIDE);
        assertThat(together.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(together.losses()).isEmpty();
        assertThat(oneByOne.losses())
                .singleElement()
                .satisfies(loss -> assertThat(loss.lost())
                        .extracting(Transition::name)
                        .containsExactlyInAnyOrder("Tm1", "Ts1''", "Tms1''", "Tms2''"));
    }

    /**
     * For any net: the same dead markings as the full graph, with shortest traces that lead to them, and the lost
     * transitions of its terminal components.
     */
    @Test
    void searches_ofRandomNets_findWhatTheFullGraphShows() {
        var compared = 0;
        var reduced = 0;
        var withDead = 0;
        var progressReduced = 0;
        var partial = 0;
        for (var seed = 1L; seed <= Thorough.times(200, 2_000); seed++) {
            var net = Nets.any(new Random(seed));
            var limits = SearchLimits.markings(3000);
            var graph = ReachabilityGraph.explore(net, limits);
            if (!graph.isComplete()) {
                continue;
            }
            var search = DeadlockSearch.run(net, limits);
            var progress = ProgressSearch.run(net, limits);
            var expected = Liveness.of(graph).terminalComponents().stream()
                    .map(component -> Set.copyOf(component.neverFired()))
                    .filter(lost -> !lost.isEmpty())
                    .collect(toSet());
            var all = net.transitions().size();
            compared++;
            reduced += search.visitedMarkings() < graph.size() ? 1 : 0;
            withDead += graph.dead().isEmpty() ? 0 : 1;
            progressReduced += progress.visitedMarkings() < graph.size() ? 1 : 0;
            partial += expected.stream().anyMatch(lost -> lost.size() < all) ? 1 : 0;

            assertThat(List.of(search.end(), progress.end()))
                    .as("seed %d", seed)
                    .containsOnly(SearchEnd.COMPLETE);
            assertThat(search.deadlocks())
                    .as("seed %d", seed)
                    .extracting(DeadlockSearch.Deadlock::marking)
                    .containsExactlyInAnyOrderElementsOf(deadMarkings(graph));
            for (var dead : search.deadlocks()) {
                var nearest = graph.find(dead.marking()).orElseThrow();
                assertThat(dead.trace()).as("seed %d", seed).hasSameSizeAs(nearest.shortestTrace());
                assertThat(net.fire(net.initialMarking(), dead.trace())).isEqualTo(dead.marking());
            }
            assertThat(progress.losses().stream()
                            .map(loss -> Set.copyOf(loss.lost()))
                            .collect(toSet()))
                    .as("losses of seed %d", seed)
                    .isEqualTo(expected);
        }
        assertThat(compared).isGreaterThan(Thorough.times(100, 1_500));
        assertThat(reduced).isGreaterThan(Thorough.times(25, 500));
        assertThat(withDead).isGreaterThan(Thorough.times(25, 500));
        assertThat(progressReduced).as("smaller").isGreaterThan(Thorough.times(15, 300));
        assertThat(partial).as("with a partial loss").isGreaterThan(Thorough.times(5, 100));
    }
}
