package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.PaperNets.Reading;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

class PermanentBlockTest {
    private static List<PermanentBlock> blocks(PetriNet net, int maxPlaces) {
        return Liveness.of(ReachabilityGraph.explore(net)).permanentBlocks(maxPlaces);
    }

    private static List<String> described(List<PermanentBlock> blocks) {
        return blocks.stream()
                .map(block -> block.places() + " " + block.markings() + " "
                        + block.nearest().shortestTrace().size())
                .toList();
    }

    @Test
    void uncorrectedA_hasThreeBlocks() {
        assertThat(described(blocks(PaperNets.uncorrected(Reading.A), 4)))
                .containsExactly("[M1, S10] 36 6", "[P1, R7''] 32 8", "[S2'', M8''] 36 21");
    }

    @ParameterizedTest
    @EnumSource
    void correctedNet_hasNone(Reading reading) {
        assertThat(blocks(PaperNets.corrected(reading), 4)).isEmpty();
    }

    @Test
    void lastPlace_isABlockAndAPlaceThatIsAlwaysMarkedIsNot() {
        var net = PetriNet.builder("end")
                .place("always", 1)
                .place("a", 1)
                .place("finished")
                .transition("go", List.of("a", "always"), List.of("finished", "always"))
                .build();

        assertThat(described(blocks(net, 3))).containsExactly("[finished] 1 1");
    }

    /** Each philosopher takes the fork at the left, then the one at the right. */
    @Test
    void circle_ofThree_needsThreePlaces() {
        var net = PetriNet.builder("philosophers");
        for (var i = 0; i < 3; i++) {
            net.place("think" + i, 1).place("wait" + i).place("eat" + i).place("fork" + i, 1);
        }
        for (var i = 0; i < 3; i++) {
            var right = "fork" + (i + 1) % 3;
            net.transition("left" + i, List.of("think" + i, "fork" + i), List.of("wait" + i));
            net.transition("right" + i, List.of("wait" + i, right), List.of("eat" + i));
            net.transition("done" + i, List.of("eat" + i), List.of("think" + i, "fork" + i, right));
        }

        assertThat(blocks(net.build(), 2)).isEmpty();
        assertThat(described(blocks(net.build(), 3))).containsExactly("[wait0, wait1, wait2] 1 3");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> blocks(net.build(), 0))
                .withMessage("maxPlaces is 0, expected 1 or more");
    }

    /** Compared with the definition, tested on every set of one and of two places. */
    @Test
    void blocks_ofRandomNets_agreeWithTheDefinition() {
        var found = 0;
        for (var seed = 1L; seed <= 300; seed++) {
            var net = RandomNets.any(new Random(seed));
            var graph = ReachabilityGraph.explore(net, 150);
            if (!graph.isComplete()) {
                continue;
            }
            var expected = new ArrayList<List<Place>>();
            for (var p : net.places()) {
                if (isBlock(graph, List.of(p))) {
                    expected.add(List.of(p));
                }
            }
            for (var p : net.places()) {
                for (var q : net.places().subList(p.index() + 1, net.places().size())) {
                    var alone = isBlock(graph, List.of(p)) || isBlock(graph, List.of(q));
                    if (!alone && !isAlways(graph, p) && !isAlways(graph, q) && isBlock(graph, List.of(p, q))) {
                        expected.add(List.of(p, q));
                    }
                }
            }
            found += expected.size();

            assertThat(Liveness.of(graph).permanentBlocks(2))
                    .as("seed %d", seed)
                    .extracting(PermanentBlock::places)
                    .containsExactlyInAnyOrderElementsOf(expected);
        }
        assertThat(found).isGreaterThan(100);
    }

    private static boolean isAlways(ReachabilityGraph graph, Place place) {
        return graph.states().stream().allMatch(state -> state.marking().tokens(place) > 0);
    }

    private static boolean isBlock(ReachabilityGraph graph, List<Place> places) {
        var blocked = graph.states().stream()
                .filter(state -> areMarked(state, places))
                .toList();
        return !blocked.isEmpty()
                && places.stream().noneMatch(place -> isAlways(graph, place))
                && blocked.stream()
                        .allMatch(state ->
                                state.successors().stream().allMatch(edge -> areMarked(edge.target(), places)));
    }

    private static boolean areMarked(ReachabilityGraph.State state, List<Place> places) {
        return places.stream().allMatch(place -> state.marking().tokens(place) > 0);
    }
}
