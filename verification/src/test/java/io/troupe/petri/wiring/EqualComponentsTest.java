package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.acquires;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.releases;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Symmetry;
import io.troupe.petri.wiring.WiringResult.Blocked;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import io.troupe.tools.Thorough;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.Random;
import java.util.TreeMap;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Wirings with n equal components, which are searched by orbits where all markings are too many. */
class EqualComponentsTest {
    private static Protocol server() {
        return Protocol.of("server")
                .state("free", provides("begin").then("busy"))
                .state("busy", provides("end").then("free"))
                .build();
    }

    /** Each of n workers takes two of the tools, one after the other. */
    private static Wiring workers(int count, int tools, Branch... whileHoldingBoth) {
        var worker = Protocol.of("worker")
                .state("idle", acquires("tool").then("one"))
                .state("one", acquires("tool").then("both"))
                .state(
                        "both",
                        Stream.concat(Stream.of(releases("tool").then("back")), Stream.of(whileHoldingBoth))
                                .toArray(Branch[]::new))
                .state("back", releases("tool").then("idle"));
        if (whileHoldingBoth.length > 0) {
            worker.state("gone", does("rest").then("gone"));
        }
        return Wiring.of(count + " workers")
                .components("worker", count, worker.build())
                .resource("tool", tools)
                .build();
    }

    /** There is one tool more than workers, so that one of them can always take its second. */
    @ParameterizedTest
    @ValueSource(ints = {2, 20})
    void equalWorkers_canAlwaysGoOn(int count) {
        var wiring = workers(count, count + 1);
        assertThat(Symmetry.find(wiring.net())).hasToString(count + " equal parts");
        assertThat(WiringCheck.check(wiring, 20_000)).isInstanceOfSatisfying(Proved.class, proved -> {
            assertThat(proved.figures().isComplete()).isEqualTo(count == 2);
            assertThat(proved.reduced().showsBlocks()).isTrue();
            if (count > 2) {
                assertThat(proved.reduced().method()).isEqualTo("orbits of " + count + " equal parts");
                assertThat(proved.reduced().markings()).isLessThan(10 * count * count);
            }
        });
    }

    /** If a worker keeps its two tools, each of the 11 others may take one of the last 11. */
    @Test
    void blockOfEqualWorkers_isFoundWithItsStory() {
        var wiring = workers(12, 13, does("leave").then("gone"));
        var result = (Blocked) WiringCheck.check(wiring, 20_000);
        assertThat(result.reduced().method()).isEqualTo("orbits of 12 equal parts");
        assertThat(result.figures().isComplete()).isFalse();
        assertThat(result.counterexamples()).hasSize(1);
        assertThat(result.counterexample().firings())
                .hasSize(14)
                .filteredOn(step -> step.endsWith(": leave"))
                .hasSize(1);
    }

    /**
     * Each of n workers takes two of n + 1 tools, and then rests. The first searches, of 1,000 markings, are not
     * enough; the long ones are.
     */
    private static ReducedFigures longSearch(int count) {
        var worker = Protocol.of("worker")
                .state("idle", acquires("tool").then("one"))
                .state("one", acquires("tool").then("both"))
                .state("both", releases("tool").then("back"))
                .state("back", releases("tool").then("tired"))
                .state("tired", does("rest").then("rested"))
                .state("rested", does("get up").then("idle"))
                .build();
        var wiring = Wiring.of(count + " workers")
                .components("worker", count, worker)
                .resource("tool", count + 1)
                .build();
        var net = wiring.net();
        var cost = 1L + net.places().size() + net.transitions().size();
        var result = new WiringCheck(wiring, SearchLimits.markings(10_000), 10_000 * cost).result();
        assertThat(result).isInstanceOf(Proved.class);
        return result.reduced();
    }

    @Test
    void longSearch_ofSevenEqualWorkers_isWithoutOrbitsFirst() {
        var reduced = longSearch(7);
        assertThat(reduced.method()).isEqualTo("stubborn sets");
        assertThat(reduced.markings()).isGreaterThan(1_000);
    }

    /**
     * One worker stays in its place and holds h tools: 0 in three states, 1 in two, 2 in one. Of the 7 others m hold
     * one tool, in two states, b hold two, and the rest none, in three states; m + 2 b is at most 9 - h. The sum over
     * h, m and b of the ways to be in these states, (m + 1) (9 - m - b) (8 - m - b) / 2, is 4,378.
     */
    @Test
    void longSearch_ofEightEqualWorkers_isByOrbitsFirst() {
        var reduced = longSearch(8);
        assertThat(reduced.method()).isEqualTo("orbits of 8 equal parts");
        assertThat(reduced.markings()).isEqualTo(4_378);
    }

    /** Random wirings of equal components: the verdicts of the full graph, from the orbits alone. */
    @Test
    void verdicts_ofRandomWirings_areThoseOfTheFullGraph() {
        var verdicts = new TreeMap<String, Integer>();
        for (var seed = 1L; seed <= Thorough.times(100, 600); seed++) {
            var wiring = random(new Random(seed));
            var whole = WiringCheck.check(wiring, 100_000);
            assertThat(whole.figures().isComplete()).as("seed %d", seed).isTrue();
            verdicts.merge(whole.getClass().getSimpleName(), 1, Integer::sum);
            var net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
            var symmetry = Symmetry.find(net.net());
            var byOrbits = new WiringCheck.OrbitCheck(wiring, net, symmetry, SearchLimits.markings(100_000)).result();
            assertThat(byOrbits.isEmpty()).as("seed %d: %s", seed, whole).isEqualTo(whole instanceof Deadlock);
            if (byOrbits.isPresent()) {
                var blocks = byOrbits.orElseThrow().blocks();
                assertThat(blocks.isEmpty()).as("seed %d: %s", seed, whole).isEqualTo(whole instanceof Proved);
                var search = new WiringSearch(wiring, net, ReachabilityGraph.explore(net.net()));
                assertThat(blocks.stream().map(each -> each.firings().size()).sorted())
                        .as("seed %d", seed)
                        .containsExactlyElementsOf(wiring.components().stream()
                                .filter(component -> component.endsWith("1") || component.equals("server"))
                                .flatMap(component -> search.block(component).stream())
                                .map(each -> each.firings().size())
                                .sorted()
                                .toList());
            }
        }
        assertThat(verdicts).containsOnlyKeys("Blocked", "Deadlock", "Proved");
        assertThat(verdicts.values()).as("%s", verdicts).allMatch(count -> count > Thorough.times(2, 30));
    }

    /** Workers that take a tool or ask the server in any order, and some of which leave. */
    private static Wiring random(Random random) {
        var protocol = Protocol.of("c");
        var steps = new ArrayList<Branch>();
        var held = 0;
        while (steps.size() < 5 && (steps.size() < 2 || random.nextInt(4) > 0)) {
            var next = "s" + (steps.size() + 1);
            var kind = random.nextInt(4);
            held += kind == 0 ? 1 : 0;
            steps.add(
                    kind == 0
                            ? acquires("tool").then(next)
                            : kind == 1
                                    ? requests("server.begin").then(next)
                                    : kind == 2
                                            ? requests("server.end").then(next)
                                            : does("step").then(next));
        }
        for (; held > 0; held--) {
            steps.add(releases("tool").then("s" + (steps.size() + 1)));
        }
        var leaving = random.nextInt(2 * steps.size());
        for (var i = 0; i < steps.size(); i++) {
            protocol.state(
                    "s" + i,
                    i == leaving
                            ? new Branch[] {steps.get(i), does("leave").then("gone")}
                            : new Branch[] {steps.get(i)});
        }
        protocol.state("s" + steps.size(), does("begin again").then("s0"));
        if (leaving < steps.size()) {
            protocol.state("gone", does("rest").then("gone"));
        }
        var built = protocol.build();
        var count = 2 + random.nextInt(2);
        var wiring = Wiring.of("random")
                .component(server())
                .components("c", count, built)
                .resource("tool", 1 + random.nextInt(count + 1));
        Stream.of("server.begin", "server.end")
                .filter(call -> !built.requested().contains(call))
                .forEach(wiring::open);
        return wiring.build();
    }
}
