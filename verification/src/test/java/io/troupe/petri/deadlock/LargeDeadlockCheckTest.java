package io.troupe.petri.deadlock;

import static io.troupe.petri.Nets.net;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.LargeNet;
import io.troupe.petri.Nets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Pnml;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.deadlock.LargeDeadlockCheck.CanDeadlock;
import io.troupe.petri.deadlock.LargeDeadlockCheck.Unknown;
import io.troupe.tools.Thorough;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Nets with answers worked out by hand, and small random nets beside their full graphs. */
class LargeDeadlockCheckTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(3000);
    private static final long LAKE = 4_000_000_000L;

    /** With four thousand million tokens on the place "lake". */
    private static LargeDeadlockCheck.Result decide(PetriNet net) {
        return LargeDeadlockCheck.decide(LargeNet.of(net, Map.of(net.place("lake"), LAKE)), LIMITS);
    }

    private static void assertDead(LargeDeadlockCheck.Result result, String trace, String marking) {
        assertThat(result).isInstanceOfSatisfying(CanDeadlock.class, found -> {
            assertThat(found.trace()).hasToString(trace);
            assertThat(found.marking()).hasToString(marking);
        });
    }

    private static void assertUnknown(LargeDeadlockCheck.Result result, String reason) {
        assertThat(result).isEqualTo(new Unknown(reason));
    }

    @Test
    void deadlock_withoutALackOfTokens_isFoundWithAllTokens() {
        var net = net("n", "lake idle=1 stuck", "work: idle lake > idle", "stop: idle > stuck");
        assertDead(decide(net), "[stop]", "{4000000000*lake, stuck}");
    }

    @Test
    void file_isReadAndSearched(@TempDir Path directory) throws IOException {
        var file = Files.writeString(directory.resolve("lake.pnml"), """
                <pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml"><net id="n"
                type="http://www.pnml.org/version-2009/grammar/ptnet"><page id="g"><place id="lake"><initialMarking>
                <text>4000000000</text></initialMarking></place></page></net></pnml>
                """);
        var warnings = new ArrayList<String>();
        var large = Pnml.readLarge(file, warnings::add);
        var result = LargeDeadlockCheck.decide(large, SearchLimits.markings(1_000_000));
        assertThat(result).isInstanceOf(LargeDeadlockCheck.CanDeadlock.class);
        assertDead(result, "[]", "{4000000000*lake}");
        assertThat(warnings).isEmpty();
    }

    @Test
    void deadlock_afterTokensWereTakenAndPut_hasTheTrueTokens() {
        assertDead(
                decide(net("n", "lake job=3 done", "work: job 2*lake > done")),
                "[work, work, work]",
                "{3999999994*lake, 3*done}");
        assertDead(
                decide(net("n", "job=3 lake", "fill: job > 1000000000*lake")),
                "[fill, fill, fill]",
                "{7000000000*lake}");
    }

    /** After four thousand million firings the net is dead, but no search gets there. */
    @Test
    void deadlock_forLackOfTokens_isNotKnown() {
        assertUnknown(
                decide(net("n", "lake glass", "drink: lake >")),
                "no marking is dead while [lake] enable and inhibit what they do at first (reductions leave a transition"
                        + " that needs no tokens); what follows then is not searched");
    }

    /** Two firings of three are possible with these tokens. */
    @Test
    void trace_thatNeedsMoreTokensThanThereAre_isNoAnswer() {
        assertUnknown(
                decide(net("n", "lake job=3", "work: job 2000000000*lake >")),
                "the dead marking that was found in the net without [lake] is none with their tokens");
    }

    /** While there are tokens, "back" is inhibited and "stop" leads to a dead marking. */
    @Test
    void inhibitorArc_fromALargePlace_preventsFirings() {
        var net = net("n", "lake idle=1 stuck", "work: idle lake > idle", "stop: idle > stuck", "back: stuck > idle");
        assertDead(decide(net.toBuilder().inhibitor("lake", "back").build()), "[stop]", "{4000000000*lake, stuck}");
    }

    /** The trace to the dead marking of the net without the lake empties the lake, and then "back" is enabled. */
    @Test
    void inhibitorArc_fromALargePlaceThatIsEmptied_preventsNothing() {
        var net = net("n", "lake full=2 gone", "pour: full 2000000000*lake > gone", "back: gone > full");
        assertUnknown(
                decide(net.toBuilder().inhibitor("lake", "back").build()),
                "the dead marking that was found in the net without [lake] is none with their tokens");
    }

    /** One token more on the lake is one too many for 64 bits. */
    @Test
    void trace_thatOverflowsALargePlace_isNoAnswer() {
        var net = net("n", "lake job=1", "fill: job > lake");
        assertThat(LargeDeadlockCheck.decide(LargeNet.of(net, Map.of(net.place("lake"), Long.MAX_VALUE)), LIMITS))
                .isEqualTo(new Unknown("the trace that was found cannot be fired: place lake would hold more than "
                        + Long.MAX_VALUE + " tokens"));
    }

    @Test
    void search_thatEndsEarly_givesItsEndAndLargePlaces() {
        var net = net("n", "lake a=1 b", "ab: a lake > b", "ba: b > a");
        assertThat(LargeDeadlockCheck.decide(
                        LargeNet.of(net, Map.of(net.place("lake"), LAKE)), LIMITS.cancelledBy(() -> true)))
                .isEqualTo(
                        new Unknown("no dead marking among 1 of the net without [lake], end of the search: CANCELLED"));
        assertThatIllegalArgumentException()
                .isThrownBy(() -> LargeDeadlockCheck.decide(LargeNet.of(net, Map.of()), LIMITS))
                .withMessage("net n has no large places");
    }

    /** A place that holds as many tokens as an int can gets one more. */
    @Test
    void smallPlace_thatOverflows_makesItUnknown() {
        var net = net("n", "lake on=1 much=2147483647 off", "more: on lake > on much", "stop: on > off");
        assertUnknown(
                decide(net.toBuilder().inhibitor("much", "stop", 5).build()),
                "the net without [lake] cannot be searched: place much would hold 2147483648 tokens, more than 2147483647");
    }

    /**
     * Some places of nets with few tokens are declared large. Every dead marking that is found is one of the full
     * graph, and is reached by the trace. Without inhibitor arcs and priorities, each dead marking lacks tokens on
     * large places if there is none before.
     */
    @Test
    void results_ofRandomNets_agreeWithTheFullGraph() {
        var found = 0;
        var onlyForLack = 0;
        var free = 0;
        var noneWithTokens = 0;
        for (var seed = 1L; seed <= Thorough.times(150, 1_500); seed++) {
            var random = new Random(seed);
            var net = random(seed, random);
            var graph = ReachabilityGraph.explore(net, LIMITS);
            if (!graph.isComplete()) {
                continue;
            }
            var large = large(net, random);
            switch (LargeDeadlockCheck.decide(large, LIMITS)) {
                case CanDeadlock dead -> {
                    found++;
                    var trace = dead.trace().stream()
                            .map(t -> net.transition(t.name()))
                            .toList();
                    var end = net.fire(net.initialMarking(), trace);
                    assertThat(dead.marking()).as("seed %d", seed).hasToString(end.toString());
                    assertThat(net.enabled(end)).as("seed %d", seed).isEmpty();
                    assertThat(graph.dead())
                            .as("seed %d", seed)
                            .anyMatch(state -> state.marking().equals(end));
                }
                case Unknown unknown -> {
                    if (unknown.reason().startsWith("no marking is dead while ") && isPlain(net)) {
                        assertThat(graph.dead())
                                .as("seed %d: %s", seed, unknown)
                                .allMatch(state -> lacksOnlyLarge(net, large.largePlaces(), state));
                        onlyForLack += graph.dead().isEmpty() ? 0 : 1;
                        free += graph.dead().isEmpty() ? 1 : 0;
                    }
                    noneWithTokens += unknown.reason().startsWith("the dead marking ") ? 1 : 0;
                }
            }
        }
        assertThat(List.of(found, onlyForLack, free, noneWithTokens))
                .as("found, dead for lack of tokens, without dead markings, not dead with all tokens")
                .allMatch(count -> count > Thorough.times(1, 20));
    }

    private static boolean isPlain(PetriNet net) {
        return !net.hasInhibitors()
                && net.transitions().stream()
                        .allMatch(t ->
                                t.priority() == net.transitions().getFirst().priority());
    }

    private static PetriNet random(long seed, Random random) {
        return switch ((int) (seed % 4)) {
            case 0 -> Nets.inhibited(Nets.any(random), random);
            case 1 -> Nets.parts(2, random);
            case 2 -> Nets.sparse(seed, 2);
            default -> Nets.any(random);
        };
    }

    /** The net with one or two large places. Its own tokens there are wrong, which must not matter. */
    private static LargeNet large(PetriNet net, Random random) {
        var tokens = new HashMap<String, Long>();
        for (var i = 0; i < 2; i++) {
            var place = net.places().get(random.nextInt(net.places().size()));
            tokens.put(place.name(), (long) place.tokens());
        }
        var wrong = PetriNet.builder(net.name());
        net.places()
                .forEach(place ->
                        wrong.place(place.name(), place.tokens() + (tokens.containsKey(place.name()) ? 3 : 0)));
        for (var t : net.transitions()) {
            wrong.transition(t.name()).priority(t.name(), t.priority());
            t.inputs().forEach(arc -> wrong.arc(arc.place().name(), t.name(), arc.weight()));
            t.outputs().forEach(arc -> wrong.arc(t.name(), arc.place().name(), arc.weight()));
            t.inhibitors().forEach(arc -> wrong.inhibitor(arc.place().name(), t.name(), arc.weight()));
        }
        var built = wrong.build();
        var large = new HashMap<Place, Long>();
        tokens.forEach((name, count) -> large.put(built.place(name), count));
        return LargeNet.of(built, large);
    }

    /** Whether some transition has its tokens on all other places. */
    private static boolean lacksOnlyLarge(PetriNet net, List<Place> large, ReachabilityGraph.State state) {
        var names = large.stream().map(Place::name).toList();
        return net.transitions().stream()
                .anyMatch(t -> t.inputs().stream()
                        .allMatch(arc -> names.contains(arc.place().name())
                                || state.marking().tokens(arc.place()) >= arc.weight()));
    }
}
