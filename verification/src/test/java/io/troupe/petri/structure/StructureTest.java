package io.troupe.petri.structure;

import static io.troupe.petri.Nets.net;
import static io.troupe.petri.Nets.refused;
import static io.troupe.petri.PaperNets.Reading.A;
import static java.util.stream.Collectors.counting;
import static java.util.stream.Collectors.groupingBy;
import static java.util.stream.Collectors.joining;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Arc;
import io.troupe.petri.Nets;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.RobotTeams;
import io.troupe.tools.Thorough;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.Collection;
import java.util.Comparator;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.BooleanSupplier;
import java.util.regex.Pattern;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Siphons, traps and invariants. */
class StructureTest {
    /** Two ways between a and b, a source into c, and a sink from d. */
    private static final PetriNet SMALL =
            net("small", "a=1 b c d=1", "there: a > b", "back: b > a", "source: > c", "sink: d >");

    static BooleanSupplier after(int questions) {
        var asked = new AtomicInteger();
        return () -> asked.incrementAndGet() > questions;
    }

    /** Lists of sets of places that other tools found, from a file of the form {"list": [["P1", "P4"], ...], ...}. */
    private static Set<Set<String>> read(String file, String list) throws IOException {
        try (var in = Objects.requireNonNull(StructureTest.class.getResourceAsStream(file), file)) {
            var text = new String(in.readAllBytes(), StandardCharsets.UTF_8);
            var body = Pattern.compile("\"" + list + "\"\\s*:\\s*\\[((?:\\s*\\[[^\\[\\]]*\\]\\s*,?)*)\\s*\\]")
                    .matcher(text);
            assertThat(body.find())
                    .as(file + " has a list of lists called " + list)
                    .isTrue();
            var sets = Pattern.compile("\\[([^\\[\\]]*)\\]").matcher(body.group(1));
            return sets.results()
                    .map(set -> Set.of(set.group(1).strip().replace("\"", "").split("\\s*,\\s*")))
                    .collect(toSet());
        }
    }

    private static Set<Set<String>> names(Collection<PlaceSet> sets) {
        return sets.stream()
                .map(set -> set.places().stream().map(Place::name).collect(toSet()))
                .collect(toSet());
    }

    @ParameterizedTest
    @CsvSource({"A, false, 44, 24", "A, true, 48, 144", "B, false, 36, 24", "B, true, 48, 144"})
    void paperNet_hasTheKnownNumbersOfMinimalSiphonsAndTraps(
            Reading reading, boolean corrected, int siphons, int traps) {
        var net = Nets.paper(reading, corrected);
        var foundSiphons = Siphons.minimalSiphons(net);
        var foundTraps = Siphons.minimalTraps(net);
        assertThat(foundSiphons.isComplete() && foundTraps.isComplete()).isTrue();
        assertThat(foundSiphons.sets()).hasSize(siphons).doesNotHaveDuplicates().allMatch(Siphons::isSiphon);
        assertThat(foundTraps.sets()).hasSize(traps).doesNotHaveDuplicates().allMatch(Siphons::isTrap);
    }

    @ParameterizedTest
    @CsvSource({
        "false, uncorrected-siphons.json, '{7=2, 8=6, 9=8, 10=7, 11=5, 12=5, 13=6, 14=4, 15=1}'",
        "true,  corrected-siphons.json,   '{7=2, 8=9, 9=15, 10=13, 11=7, 12=2}'"
    })
    void paperNet_ofReadingA_hasTheSetsThatOtherToolsFound(boolean corrected, String file, String sizes)
            throws IOException {
        var net = Nets.paper(A, corrected);
        var siphons = Siphons.minimalSiphons(net).sets();
        var candidates = siphons.stream()
                .filter(siphon -> new StateEquation(net).lowerBound(siphon).isEmpty())
                .toList();
        assertThat(names(siphons)).isEqualTo(read(file, "minimalSiphons"));
        assertThat(names(Siphons.minimalTraps(net).sets())).isEqualTo(read(file, "minimalTraps"));
        assertThat(names(candidates)).isEqualTo(read(file, "emptiable"));
        var bySize = siphons.stream().collect(groupingBy(PlaceSet::size, TreeMap::new, counting()));
        assertThat(bySize).hasToString(sizes);
        assertThat(siphons).isSortedAccordingTo(Comparator.comparingInt(PlaceSet::size));
    }

    @Test
    void twoRobots_haveTheKnownNumberOfMinimalSiphons() {
        var uncorrected = Siphons.minimalSiphons(RobotTeams.uncorrected(2));
        var corrected = Siphons.minimalSiphons(RobotTeams.stoppingTogether(2));
        assertThat(uncorrected.isComplete() && corrected.isComplete()).isTrue();
        assertThat(uncorrected.sets()).hasSize(112).doesNotHaveDuplicates();
        assertThat(corrected.sets()).hasSize(248).doesNotHaveDuplicates();
    }

    @Test
    void search_thatEndsEarly_hasFoundOnlyMinimalOnesAndSaysSo() {
        var net = PaperNets.uncorrected(A);
        var all = Siphons.minimalSiphons(net).sets();
        var limited = Siphons.minimalSiphons(net, 20);
        var cancelled = Siphons.minimalSiphons(net, Siphons.DEFAULT_MAX_STEPS, after(2_000));
        for (var some : List.of(limited, cancelled)) {
            assertThat(some.isComplete()).isFalse();
            assertThat(some.sets()).isNotEmpty().hasSizeLessThan(44).isSubsetOf(all);
        }
        assertThat(Siphons.minimalSiphons(net, 1, () -> true)).isEqualTo(new MinimalSets(List.of(), false));
        refused(() -> Siphons.minimalSiphons(net, 0), "maxSteps is 0, expected 1 or more");
    }

    /** Each place is a siphon; the first step alone tests all 20,000 places 20,000 times. */
    @Test
    void search_cancelledWithinOneStep_endsThere() {
        var net =
                net("places", IntStream.range(0, 20_000).mapToObj(i -> "p" + i).collect(joining(" ")));
        var none = new MinimalSets(List.of(), false);
        assertThat(Siphons.minimalSiphons(net, Siphons.DEFAULT_MAX_STEPS, after(50)))
                .isEqualTo(none);
        assertThat(Siphons.minimalTraps(net, Siphons.DEFAULT_MAX_STEPS, after(50)))
                .isEqualTo(none);
    }

    @Test
    void smallNets_sourcesSinksAndPlacesWithoutTransitions_countAsTheDefinitionSays() {
        assertThat(Siphons.minimalSiphons(SMALL).sets()).hasToString("[{d}, {a, b}]");
        assertThat(Siphons.minimalTraps(SMALL).sets()).hasToString("[{c}, {a, b}]");
        assertThat(Siphons.isSiphon(PlaceSet.of(SMALL, "c"))).isFalse();
        assertThat(Siphons.isTrap(PlaceSet.of(SMALL, "d"))).isFalse();
        var still = net("still", "a b");
        assertThat(Siphons.minimalSiphons(still).sets()).hasToString("[{a}, {b}]");
        assertThat(Siphons.minimalTraps(still).sets()).hasToString("[{a}, {b}]");
    }

    @Test
    void largestOnes_areWhatRemainsWhenNothingMustGo() {
        var all = PlaceSet.of(SMALL, SMALL.places());
        assertThat(Siphons.largestSiphonIn(all)).isEqualTo(PlaceSet.of(SMALL, "a", "b", "d"));
        assertThat(Siphons.largestTrapIn(all)).isEqualTo(PlaceSet.of(SMALL, "a", "b", "c"));
        assertThat(Siphons.largestTrapIn(PlaceSet.of(SMALL, "a", "c"))).isEqualTo(PlaceSet.of(SMALL, "c"));
        assertThat(Siphons.largestTrapIn(PlaceSet.of(SMALL, "a")).isEmpty()).isTrue();
    }

    @Test
    void placeSet_countsTokensAndRefusesForeignPlaces() {
        var set = PlaceSet.of(SMALL, "a", "b", "d");
        assertThat(set.tokens(SMALL.initialMarking())).isEqualTo(2);
        assertThat(set.isMarked(SMALL.marking("c"))).isFalse();
        assertThat(SMALL.places()).filteredOn(set::contains).hasToString("[a, b, d]");
        assertThat(set.containsAll(PlaceSet.of(SMALL, "a", "d"))).isTrue();
        assertThat(PlaceSet.of(SMALL, "a", "d").containsAll(set)).isFalse();
        var foreign = List.of(PaperNets.robot().place("R1"));
        refused(() -> PlaceSet.of(SMALL, foreign), "place R1 is not of net small");
    }

    @Test
    void minimalSetsOfRandomNets_areThoseOfTheDefinition() {
        for (var seed = 1L; seed <= Thorough.times(300, 3_000); seed++) {
            var net = Nets.sparse(seed, 1);
            var siphons = Siphons.minimalSiphons(net).sets();
            var traps = Siphons.minimalTraps(net).sets();
            assertThat(siphons).as("siphons, seed %d", seed).doesNotHaveDuplicates();
            assertThat(Set.copyOf(siphons)).as("seed %d", seed).isEqualTo(new Definition(net, false).minimal());
            assertThat(traps).as("traps, seed %d", seed).doesNotHaveDuplicates();
            assertThat(Set.copyOf(traps)).as("seed %d", seed).isEqualTo(new Definition(net, true).minimal());
        }
    }

    @Test
    void largestSiphonAndTrap_inEverySetOfRandomNets_areThoseOfTheDefinition() {
        for (var seed = 1L; seed <= Thorough.times(15, 150); seed++) {
            var net = Nets.sparse(seed, 1);
            var siphons = new Definition(net, false);
            var traps = new Definition(net, true);
            for (var mask : siphons.subsets().toArray()) {
                var set = siphons.set(mask);
                var as = "seed " + seed + ", " + set;
                assertThat(Siphons.isSiphon(set)).as(as).isEqualTo(siphons.isClosed(mask));
                assertThat(Siphons.isTrap(set)).as(as).isEqualTo(traps.isClosed(mask));
                assertThat(Siphons.largestSiphonIn(set)).as(as).isEqualTo(siphons.largestIn(mask));
                assertThat(Siphons.largestTrapIn(set)).as(as).isEqualTo(traps.largestIn(mask));
            }
        }
    }

    /** Siphons or traps of a small net, found by testing all sets of places; a set is a bit mask. */
    private record Definition(PetriNet net, boolean traps) {
        /** All sets of places but the empty one. */
        IntStream subsets() {
            return IntStream.range(1, 1 << net.places().size());
        }

        boolean isClosed(int set) {
            return net.transitions().stream().allMatch(t -> {
                var feeding = touches(traps ? t.inputs() : t.outputs(), set);
                var needed = touches(traps ? t.outputs() : t.inputs(), set);
                return !feeding || needed;
            });
        }

        private static boolean touches(List<Arc> arcs, int set) {
            return arcs.stream().anyMatch(arc -> (set >> arc.place().index() & 1) != 0);
        }

        Set<PlaceSet> minimal() {
            var closed = subsets().filter(this::isClosed).toArray();
            return Arrays.stream(closed)
                    .filter(set -> Arrays.stream(closed).noneMatch(other -> other != set && (other & set) == other))
                    .mapToObj(this::set)
                    .collect(toSet());
        }

        /** The union of all closed sets within this one. */
        PlaceSet largestIn(int set) {
            var closed = subsets().filter(part -> (part & set) == part && isClosed(part));
            return set(closed.reduce(0, (one, other) -> one | other));
        }

        PlaceSet set(int mask) {
            var chosen = net.places().stream().filter(place -> (mask >> place.index() & 1) != 0);
            return PlaceSet.of(net, chosen.toList());
        }
    }
}
