package io.troupe.petri;

import static java.util.stream.Collectors.joining;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.PaperNets.Reading;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashSet;
import java.util.List;
import java.util.Random;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

class LivenessTest {
    private static Liveness liveness(PetriNet net) {
        return Liveness.of(ReachabilityGraph.explore(net));
    }

    private static List<Integer> sizes(Liveness liveness) {
        return liveness.terminalComponents().stream()
                .map(TerminalComponent::size)
                .sorted()
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
        var net = switch (design) {
            case "uncorrected" -> PaperNets.uncorrected(reading);
            case "corrected" -> PaperNets.corrected(reading);
            default -> PaperNets.lowPriorityStops(reading);
        };

        var liveness = liveness(net);

        assertThat(sizes(liveness))
                .isEqualTo(Arrays.stream(sizes.split(" ")).map(Integer::valueOf).toList());
        assertThat(liveness.live()).isEqualTo(live);
        assertThat(liveness.reversible()).isEqualTo(reversible);
        assertThat(liveness.graph().safe()).isEqualTo(Verdict.YES);
        assertThat(net.transitions()).allMatch(t -> liveness.live(t) != Verdict.UNKNOWN);
    }

    @Test
    void components_alone_areLiveAndSafe() {
        for (var net : List.of(
                PaperNets.robot(),
                PaperNets.player(),
                PaperNets.middleware(),
                PaperNets.service(Reading.A),
                PaperNets.service(Reading.B))) {
            assertThat(liveness(net).live()).as(net.name()).isEqualTo(Verdict.YES);
            assertThat(liveness(net).reversible()).as(net.name()).isEqualTo(Verdict.YES);
            assertThat(liveness(net).graph().safe()).as(net.name()).isEqualTo(Verdict.YES);
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

        assertThat(liveness.graph().dead().stream().map(Object::toString).collect(joining(" ")))
                .isEqualTo(dead);
        assertThat(liveness.reversible()).isEqualTo(reversible);
    }

    /** Middleware and service register and stop again and again while robot and player are stuck. */
    @Test
    void partialDeadlock_ofReadingB_isFoundWhereNoMarkingIsDead() {
        var net = PaperNets.uncorrected(Reading.B);
        var liveness = liveness(net);

        var partial = liveness.terminalComponents().stream()
                .filter(component -> !component.isDead())
                .toList();

        assertThat(partial).singleElement().satisfies(component -> {
            assertThat(component.states())
                    .hasSize(8)
                    .allMatch(state -> state.marking().covers(net.marking("P1", "R7''")));
            assertThat(component.states()).allMatch(component::contains);
            assertThat(component.fires(net.transition("Tms1''"))).isTrue();
            assertThat(component.neverFired())
                    .extracting(Transition::name)
                    .contains("Tp1", "Trp3''", "Tr4''", "Tm3")
                    .doesNotContain("Tm1", "Tm4", "Ts1''", "Ts7", "Tms1''", "Tms2''");
        });
    }

    /** The paper's third claim: no deadlock, but the robot never stops. */
    @ParameterizedTest
    @EnumSource
    void stops_ofLowerPriority_areNeverFiredInTheEnd(Reading reading) {
        var liveness = liveness(PaperNets.lowPriorityStops(reading));

        assertThat(liveness.terminalComponents())
                .singleElement()
                .satisfies(component -> assertThat(component.neverFired())
                        .extracting(Transition::name)
                        .contains("Tr6", "Tr7", "Tp4", "Tm4", "Ts7")
                        // the start and the registration happen once
                        .containsExactlyInAnyOrder(
                                "Tr6", "Tr7", "Tp4", "Tm4", "Ts7", "Tr1", "Tr2''", "Trp1''", "Tp1", "Trp2''", "Ts1''",
                                "Tms1''", "Tm1", "Tms2''"));
    }

    @Test
    void transition_thatIsLost_isShownByTheNearestComponent() {
        var net = PetriNet.builder("fork")
                .place("start", 1)
                .place("loop")
                .place("end")
                .transition("in", List.of("start"), List.of("loop"))
                .transition("turn", List.of("loop"), List.of("loop"))
                .transition("out", List.of("start"), List.of("end"))
                .build();

        var liveness = liveness(net);

        assertThat(liveness.lossOf(net.transition("turn")).orElseThrow().entry())
                .hasToString("{end}");
        assertThat(liveness.lossOf(net.transition("out")).orElseThrow().entry()).hasToString("{loop}");
        assertThat(liveness.notLive()).isEqualTo(net.transitions());
        assertThat(liveness.live(net.transition("turn"))).isEqualTo(Verdict.NO);
        assertThat(liveness.summary()).isEqualTo("""
            fork: live NO, reversible NO
              terminal components: 2
                1 marking entered at {loop}, never fired: [in, out]
                1 marking entered at {end}, never fired: [in, turn, out]\
            """);
        var other = PaperNets.player().transition("Tp1");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> liveness.live(other))
                .withMessage("net fork has no transition called Tp1");
    }

    /** A recursive search would overflow the stack of its thread. */
    @Test
    void ring_ofHundredThousandMarkings_isOneComponent() {
        var net = PetriNet.builder("ring")
                .place("a", 100_000)
                .place("b")
                .transition("ab", List.of("a"), List.of("b"))
                .transition("reset")
                .arc("b", "reset", 100_000)
                .arc("reset", "a", 100_000)
                .build();

        var liveness = liveness(net);

        assertThat(sizes(liveness)).containsExactly(100_001);
        assertThat(liveness.live()).isEqualTo(Verdict.YES);
        assertThat(liveness.reversible()).isEqualTo(Verdict.YES);
        assertThat(liveness.graph().safe()).isEqualTo(Verdict.NO);
    }

    @Test
    void graph_thatIsNotComplete_refutesOrDoesNotKnow() {
        var net = PetriNet.builder("count")
                .place("on", 1)
                .place("off")
                .place("n")
                .transition("up", List.of("on"), List.of("on", "n"))
                .build();
        var stoppable = net.toBuilder()
                .transition("stop", List.of("on"), List.of("off"))
                .build();

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

    /** Compared with the definitions, with the set of markings that each marking can reach. */
    @Test
    void components_ofRandomNets_agreeWithTheDefinitions() {
        var several = 0;
        var large = 0;
        for (var seed = 1L; seed <= 400; seed++) {
            var graph = ReachabilityGraph.explore(RandomNets.any(new Random(seed)), 120);
            if (!graph.isComplete()) {
                continue;
            }
            var liveness = Liveness.of(graph);
            var reached = graph.states().stream().map(LivenessTest::reachedFrom).toList();
            var components = new HashSet<Set<ReachabilityGraph.State>>();
            for (var from : reached) {
                if (from.stream().allMatch(to -> reached.get(to.index()).equals(from))) {
                    components.add(from);
                }
            }
            several += components.size() > 1 ? 1 : 0;
            large += components.stream().anyMatch(component -> component.size() > 2) ? 1 : 0;

            assertThat(liveness.terminalComponents())
                    .as("seed %d", seed)
                    .extracting(component -> Set.copyOf(component.states()))
                    .containsExactlyInAnyOrderElementsOf(components);
            var home = reached.stream()
                    .allMatch(from -> from.contains(graph.states().get(0)));
            assertThat(liveness.reversible()).as("seed %d", seed).isEqualTo(home ? Verdict.YES : Verdict.NO);
            for (var transition : graph.net().transitions()) {
                var live = reached.stream()
                        .allMatch(from -> from.stream()
                                .anyMatch(state -> state.successors().stream()
                                        .anyMatch(edge -> edge.transition().equals(transition))));
                assertThat(liveness.live(transition))
                        .as("seed %d, %s", seed, transition)
                        .isEqualTo(live ? Verdict.YES : Verdict.NO);
            }
        }
        assertThat(several).isGreaterThan(20);
        assertThat(large).isGreaterThan(20);
    }

    private static Set<ReachabilityGraph.State> reachedFrom(ReachabilityGraph.State start) {
        var reached = new HashSet<>(List.of(start));
        var queue = new ArrayDeque<>(new ArrayList<>(reached));
        while (!queue.isEmpty()) {
            for (var edge : queue.remove().successors()) {
                if (reached.add(edge.target())) {
                    queue.add(edge.target());
                }
            }
        }
        return reached;
    }
}
