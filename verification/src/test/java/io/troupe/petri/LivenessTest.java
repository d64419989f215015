package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static java.util.stream.Collectors.joining;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.tools.Thorough;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

/** Terminal components and permanent blocks. */
class LivenessTest {
    private static Liveness liveness(PetriNet net) {
        return Liveness.of(ReachabilityGraph.explore(net));
    }

    private static String sizes(Liveness liveness) {
        var sizes = liveness.terminalComponents().stream().map(TerminalComponent::size);
        return sizes.sorted().map(String::valueOf).collect(joining(" "));
    }

    /** Places, number of markings and steps to the nearest one. */
    private static List<String> blocks(PetriNet net, int maxPlaces) {
        return liveness(net).permanentBlocks(maxPlaces).stream()
                .map(block -> block.places() + " " + block.markings() + " "
                        + block.nearest().shortestTrace().size())
                .toList();
    }

    @ParameterizedTest
    @CsvSource({
        "A, uncorrected, 1 1 1 1 1 1, NO,  NO",
        "A, corrected,   429,         YES, YES",
        "A, priorities,  278,         NO,  NO",
        "B, uncorrected, 1 1 1 8,     NO,  NO",
        "B, corrected,   363,         YES, YES"
    })
    void wholeNet_hasTheKnownTerminalComponents(
            Reading reading, String design, String sizes, Verdict live, Verdict reversible) {
        var net = design.equals("priorities")
                ? PaperNets.lowPriorityStops(reading)
                : Nets.paper(reading, design.equals("corrected"));
        var liveness = liveness(net);
        assertThat(sizes(liveness)).isEqualTo(sizes);
        assertThat(liveness.live()).isEqualTo(live);
        assertThat(liveness.reversible()).isEqualTo(reversible);
        assertThat(liveness.graph().safe()).isEqualTo(Verdict.YES);
        assertThat(net.transitions()).allMatch(t -> liveness.live(t) != Verdict.UNKNOWN);
    }

    @ParameterizedTest
    @EnumSource
    void components_alone_areLiveAndSafe(Reading reading) {
        for (var net :
                List.of(PaperNets.robot(), PaperNets.player(), PaperNets.middleware(), PaperNets.service(reading))) {
            var liveness = liveness(net);
            assertThat(List.of(
                            liveness.live(),
                            liveness.reversible(),
                            liveness.graph().safe()))
                    .as(net.name())
                    .containsOnly(Verdict.YES);
        }
    }

    /**
     * Alternatives to the stop of the corrected net, which is the last row: the places that Tstop takes from and puts
     * to.
     */
    @ParameterizedTest
    @CsvSource({
        "R10 P4 M4 S10, R1 P4 M4 S10, '{P4, M4, S10, R3''''}', NO",
        "R10 P4 M4 S10, R1 P1 M4 S10, '', NO",
        "R10 P4 M4 S4,  R1 P1 M1 S1,  '{R10, P4, M4, S10}', NO",
        "R10 P4 M4 S10, R1 P1 M1 S1,  '', YES"
    })
    void stop_takenOrPutElsewhere_deadlocksOrDoesNotReturn(String from, String to, String dead, Verdict reversible) {
        var net = PaperNets.corrected(Reading.A).toBuilder()
                .remove("Tstop")
                .transition("Tstop", List.of(from.split(" ")), List.of(to.split(" ")))
                .build();
        var liveness = liveness(net);
        assertThat(liveness.graph().dead().stream().map(State::toString).collect(joining(" ")))
                .isEqualTo(dead);
        assertThat(liveness.reversible()).isEqualTo(reversible);
    }

    /** Middleware and service register and stop again and again while robot and player are stuck. */
    @Test
    void partialDeadlock_ofReadingB_isFoundWhereNoMarkingIsDead() {
        var net = PaperNets.uncorrected(Reading.B);
        var stuck = net.marking("P1", "R7''");
        assertThat(liveness(net).terminalComponents())
                .filteredOn(component -> !component.isDead())
                .singleElement()
                .satisfies(component -> {
                    assertThat(component.states())
                            .hasSize(8)
                            .allMatch(state -> state.marking().covers(stuck) && component.contains(state));
                    assertThat(component.fires(net.transition("Tms1''"))).isTrue();
                    assertThat(component.neverFired())
                            .extracting(Transition::name)
                            .contains("Tp1", "Trp3''", "Tr4''", "Tm3")
                            .doesNotContain("Tm1", "Tm4", "Ts1''", "Ts7", "Tms1''", "Tms2''");
                });
    }

    /** The paper's third claim: no deadlock, but the robot never stops. The start and the registration happen once. */
    @ParameterizedTest
    @EnumSource
    void stops_ofLowerPriority_areNeverFiredInTheEnd(Reading reading) {
        assertThat(liveness(PaperNets.lowPriorityStops(reading)).terminalComponents())
                .singleElement()
                .satisfies(component -> assertThat(component.neverFired())
                        .extracting(Transition::name)
                        .containsExactlyInAnyOrder(
                                "Tr6", "Tr7", "Tp4", "Tm4", "Ts7", "Tr1", "Tr2''", "Trp1''", "Tp1", "Trp2''", "Ts1''",
                                "Tms1''", "Tm1", "Tms2''"));
    }

    @Test
    void transition_thatIsLost_isShownByTheNearestComponent() {
        var net = net("fork", "start=1 loop end", "in: start > loop", "turn: loop > loop", "out: start > end");
        var liveness = liveness(net);
        var turn = liveness.lossOf(net.transition("turn")).orElseThrow();
        var out = liveness.lossOf(net.transition("out")).orElseThrow();
        assertThat(List.of(turn.entry(), out.entry())).hasToString("[{end}, {loop}]");
        assertThat(liveness.notLive()).isEqualTo(net.transitions());
        assertThat(liveness.live(net.transition("turn"))).isEqualTo(Verdict.NO);
        assertThat(liveness.summary()).isEqualTo("""
            fork: live NO, reversible NO
              terminal components: 2
                1 marking entered at {loop}, never fired: [in, out]
                1 marking entered at {end}, never fired: [in, turn, out]\
            """);
        var other = PaperNets.player().transition("Tp1");
        refused(() -> liveness.live(other), "net fork has no transition called Tp1");
    }

    @Test
    void summaries_ofManyComponentsAndNames_areShort() {
        var net = Nets.choices(10).toBuilder();
        IntStream.range(0, 1000).forEach(i -> net.place("empty" + i));
        var liveness = liveness(net.build());
        assertThat(liveness.terminalComponents()).hasSize(1024);
        assertThat(liveness.summary().lines()).hasSizeLessThan(20);
        assertThat(liveness.summary()).endsWith("\n    and 1008 more");
        assertThat(liveness.graph().summary()).contains("empty198, empty199, .. and 800 more]");
    }

    /** A recursive search would overflow the stack of its thread. */
    @Test
    void ring_ofHundredThousandMarkings_isOneComponent() {
        var liveness = liveness(net("ring", "a=100000 b", "ab: a > b", "reset: 100000*b > 100000*a"));
        assertThat(sizes(liveness)).isEqualTo("100001");
        assertThat(liveness.live()).isEqualTo(Verdict.YES);
        assertThat(liveness.reversible()).isEqualTo(Verdict.YES);
        assertThat(liveness.graph().safe()).isEqualTo(Verdict.NO);
    }

    @Test
    void graph_thatIsNotComplete_refutesOrDoesNotKnow() {
        var net = net("count", "on=1 off n", "up: on > on n");
        var stoppable = net("count", "on=1 off n", "up: on > on n", "stop: on > off");
        var endless = Liveness.of(ReachabilityGraph.explore(net, 50));
        var refuted = Liveness.of(ReachabilityGraph.explore(stoppable, 50));
        assertThat(endless.terminalComponents()).isEmpty();
        assertThat(endless.live()).isEqualTo(Verdict.UNKNOWN);
        assertThat(endless.reversible()).isEqualTo(Verdict.UNKNOWN);
        assertThat(endless.graph().safe()).isEqualTo(Verdict.NO);
        assertThat(endless.summary()).isEqualTo("""
            count: live UNKNOWN, reversible UNKNOWN
              terminal components so far: 0
              1 markings may lead to other components, which were not visited\
            """);
        assertThat(refuted.live()).isEqualTo(Verdict.NO);
        assertThat(refuted.reversible()).isEqualTo(Verdict.NO);
        assertThat(refuted.terminalComponents()).isNotEmpty().allMatch(TerminalComponent::isDead);
    }

    @Test
    void permanentBlocks_areThePlacesThatOnceMarkedStayMarked() {
        var uncorrected = PaperNets.uncorrected(Reading.A);
        assertThat(blocks(uncorrected, 4)).containsExactly("[M1, S10] 36 6", "[P1, R7''] 32 8", "[S2'', M8''] 36 21");
        assertThat(blocks(PaperNets.corrected(Reading.A), 4)).isEmpty();
        assertThat(blocks(PaperNets.corrected(Reading.B), 4)).isEmpty();
        // a place that is always marked is no block
        var end = net("end", "always=1 a=1 finished", "go: a always > finished always");
        assertThat(blocks(end, 3)).containsExactly("[finished] 1 1");
        refused(() -> blocks(end, 0), "maxPlaces is 0, expected 1 or more");
    }

    /** Each philosopher takes the fork at the left, then the one at the right. */
    @Test
    void permanentBlock_ofACircleOfThree_needsThreePlaces() {
        var table = PetriNet.builder("philosophers");
        for (var i = 0; i < 3; i++) {
            table.place("think" + i, 1).place("wait" + i).place("eat" + i).place("fork" + i, 1);
        }
        for (var i = 0; i < 3; i++) {
            var right = "fork" + (i + 1) % 3;
            table.transition("left" + i, List.of("think" + i, "fork" + i), List.of("wait" + i));
            table.transition("right" + i, List.of("wait" + i, right), List.of("eat" + i));
            table.transition("done" + i, List.of("eat" + i), List.of("think" + i, "fork" + i, right));
        }
        assertThat(blocks(table.build(), 2)).isEmpty();
        assertThat(blocks(table.build(), 3)).containsExactly("[wait0, wait1, wait2] 1 3");
    }

    /**
     * Compared with the definitions: with the set of markings that each marking can reach, and with every set of one
     * and of two places.
     */
    @Test
    void componentsAndBlocks_ofRandomNets_agreeWithTheDefinitions() {
        var several = 0;
        var large = 0;
        var found = 0;
        for (var seed = 1L; seed <= Thorough.times(80, 400); seed++) {
            var graph = ReachabilityGraph.explore(Nets.any(new Random(seed)), 150);
            if (!graph.isComplete()) {
                continue;
            }
            var liveness = Liveness.of(graph);
            var reached = graph.states().stream().map(LivenessTest::reachedFrom).toList();
            var components = new HashSet<Set<State>>();
            for (var from : reached) {
                if (from.stream().allMatch(to -> reached.get(to.index()).equals(from))) {
                    components.add(from);
                }
            }
            var blocks = blocksOfTwo(graph);
            several += components.size() > 1 ? 1 : 0;
            large += components.stream().anyMatch(component -> component.size() > 2) ? 1 : 0;
            found += blocks.size();

            assertThat(liveness.terminalComponents())
                    .as("seed %d", seed)
                    .extracting(component -> Set.copyOf(component.states()))
                    .containsExactlyInAnyOrderElementsOf(components);
            var initial = graph.states().getFirst();
            var home = reached.stream().allMatch(from -> from.contains(initial));
            assertThat(liveness.reversible()).as("seed %d", seed).isEqualTo(home ? Verdict.YES : Verdict.NO);
            for (var transition : graph.net().transitions()) {
                var live = reached.stream()
                        .allMatch(from -> from.stream()
                                .flatMap(state -> state.successors().stream())
                                .anyMatch(edge -> edge.transition().equals(transition)));
                assertThat(liveness.live(transition))
                        .as("seed %d, %s", seed, transition)
                        .isEqualTo(live ? Verdict.YES : Verdict.NO);
            }
            assertThat(liveness.permanentBlocks(2))
                    .as("blocks of seed %d", seed)
                    .extracting(PermanentBlock::places)
                    .containsExactlyInAnyOrderElementsOf(blocks);
        }
        assertThat(several).isGreaterThan(Thorough.times(2, 20));
        assertThat(large).isGreaterThan(Thorough.times(2, 20));
        assertThat(found).isGreaterThan(Thorough.times(10, 100));
    }

    private static Set<State> reachedFrom(State start) {
        var reached = new HashSet<>(List.of(start));
        var queue = new ArrayDeque<>(reached);
        while (!queue.isEmpty()) {
            for (var edge : queue.remove().successors()) {
                if (reached.add(edge.target())) {
                    queue.add(edge.target());
                }
            }
        }
        return reached;
    }

    /** The blocks of one place, and those of two places none of which is one alone. */
    private static List<List<Place>> blocksOfTwo(ReachabilityGraph graph) {
        var places = new ArrayList<>(graph.net().places());
        places.removeIf(place -> graph.states().stream().allMatch(state -> areMarked(state, List.of(place))));
        var blocks = new ArrayList<List<Place>>();
        places.stream().map(List::of).filter(one -> isBlock(graph, one)).forEach(blocks::add);
        blocks.forEach(one -> places.remove(one.getFirst()));
        for (var p : places) {
            for (var q : places.subList(places.indexOf(p) + 1, places.size())) {
                if (isBlock(graph, List.of(p, q))) {
                    blocks.add(List.of(p, q));
                }
            }
        }
        return blocks;
    }

    private static boolean isBlock(ReachabilityGraph graph, List<Place> places) {
        var blocked = graph.states().stream()
                .filter(state -> areMarked(state, places))
                .toList();
        var next = blocked.stream().flatMap(state -> state.successors().stream());
        return !blocked.isEmpty() && next.allMatch(edge -> areMarked(edge.target(), places));
    }

    private static boolean areMarked(State state, List<Place> places) {
        return places.stream().allMatch(place -> state.marking().tokens(place) > 0);
    }
}
