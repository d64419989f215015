package io.troupe.petri.structure;

import static io.troupe.petri.PaperNets.Reading.A;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import java.util.List;
import java.util.TreeMap;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SiphonsTest {
    @ParameterizedTest
    @CsvSource({"A, false, 44, 24", "A, true, 48, 144", "B, false, 36, 24", "B, true, 48, 144"})
    void paperNet_hasTheKnownNumbersOfMinimalSiphonsAndTraps(
            Reading reading, boolean corrected, int siphonCount, int trapCount) {
        var net = Nets.paper(reading, corrected);

        var siphons = Siphons.minimalSiphons(net);
        var traps = Siphons.minimalTraps(net);

        assertThat(siphons.isComplete()).isTrue();
        assertThat(siphons.sets()).hasSize(siphonCount).doesNotHaveDuplicates().allMatch(Siphons::isSiphon);
        assertThat(traps.isComplete()).isTrue();
        assertThat(traps.sets()).hasSize(trapCount).doesNotHaveDuplicates().allMatch(Siphons::isTrap);
    }

    @ParameterizedTest
    @CsvSource({"false, uncorrected-siphons.json", "true, corrected-siphons.json"})
    void paperNet_ofReadingA_hasTheSiphonsAndTrapsThatOtherToolsFound(boolean corrected, String file) {
        var net = Nets.paper(A, corrected);

        assertThat(SetLists.names(Siphons.minimalSiphons(net).sets())).isEqualTo(SetLists.read(file, "minimalSiphons"));
        assertThat(SetLists.names(Siphons.minimalTraps(net).sets())).isEqualTo(SetLists.read(file, "minimalTraps"));
    }

    @ParameterizedTest
    @CsvSource({
        "false, 7:2 8:6 9:8 10:7 11:5 12:5 13:6 14:4 15:1",
        "true,  7:2 8:9 9:15 10:13 11:7 12:2",
    })
    void paperNet_ofReadingA_hasSiphonsOfTheKnownSizes(boolean corrected, String sizes) {
        var expected = new TreeMap<Integer, Long>();
        for (var size : sizes.split(" ")) {
            expected.put(Integer.valueOf(size.split(":")[0]), Long.valueOf(size.split(":")[1]));
        }

        var siphons = Siphons.minimalSiphons(Nets.paper(A, corrected)).sets();

        assertThat(siphons.stream().collect(Collectors.groupingBy(PlaceSet::size, Collectors.counting())))
                .isEqualTo(expected);
        assertThat(siphons).isSortedAccordingTo((one, other) -> Integer.compare(one.size(), other.size()));
    }

    @ParameterizedTest
    @CsvSource({
        "robot,              '',       1",
        "player,             '',       1",
        "middleware,         '',       1",
        "service,            '',       1",
        "robot player,       Tr2,      4",
        "robot player,       Tr2 Tr4, 12",
        "player middleware,  Tp3,      4",
        "middleware service, Tm2,      4",
        "middleware service, Ts1,      4",
        "middleware service, Ts1 Tm2, 16"
    })
    void part_ofReadingA_hasTheKnownNumberOfMinimalSiphons(String components, String requests, int count) {
        assertThat(Siphons.minimalSiphons(Nets.part(components, requests)).sets())
                .hasSize(count);
    }

    @ParameterizedTest
    @CsvSource({"false, 112", "true, 248"})
    void twoRobots_haveTheKnownNumberOfMinimalSiphons(boolean corrected, int count) {
        var siphons = Siphons.minimalSiphons(Nets.twoRobots(corrected));

        assertThat(siphons.isComplete()).isTrue();
        assertThat(siphons.sets()).hasSize(count).doesNotHaveDuplicates();
    }

    @Test
    void search_stoppedAtItsLimit_hasFoundOnlyMinimalOnesAndSaysSo() {
        var net = PaperNets.uncorrected(A);
        var all = Siphons.minimalSiphons(net).sets();

        var some = Siphons.minimalSiphons(net, 20);

        assertThat(some.isComplete()).isFalse();
        assertThat(some.sets()).isNotEmpty().hasSizeLessThan(44).isSubsetOf(all);
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Siphons.minimalSiphons(net, 0))
                .withMessage("maxSteps is 0, expected 1 or more");
    }

    /** Two ways between a and b, a source into c, and a sink from d. */
    private static PetriNet small() {
        return PetriNet.builder("small")
                .place("a", 1)
                .place("b")
                .place("c")
                .place("d", 1)
                .transition("there", List.of("a"), List.of("b"))
                .transition("back", List.of("b"), List.of("a"))
                .transition("source", List.of(), List.of("c"))
                .transition("sink", List.of("d"), List.of())
                .build();
    }

    @Test
    void smallNet_sourcesAndSinks_countAsTheDefinitionSays() {
        var net = small();

        assertThat(Siphons.minimalSiphons(net).sets()).hasToString("[{d}, {a, b}]");
        assertThat(Siphons.minimalTraps(net).sets()).hasToString("[{c}, {a, b}]");
        assertThat(Siphons.isSiphon(PlaceSet.of(net, "c"))).isFalse();
        assertThat(Siphons.isTrap(PlaceSet.of(net, "d"))).isFalse();
    }

    @Test
    void largestOnes_areWhatRemainsWhenNothingMustGo() {
        var net = small();
        var all = PlaceSet.of(net, net.places());

        assertThat(Siphons.largestSiphonIn(all)).isEqualTo(PlaceSet.of(net, "a", "b", "d"));
        assertThat(Siphons.largestTrapIn(all)).isEqualTo(PlaceSet.of(net, "a", "b", "c"));
        assertThat(Siphons.largestTrapIn(PlaceSet.of(net, "a", "c"))).isEqualTo(PlaceSet.of(net, "c"));
        assertThat(Siphons.largestTrapIn(PlaceSet.of(net, "a")).isEmpty()).isTrue();
    }

    @Test
    void netWithoutTransitions_everyPlaceIsASiphonAndATrap() {
        var net = PetriNet.builder("still").place("a").place("b").build();

        assertThat(Siphons.minimalSiphons(net).sets()).hasToString("[{a}, {b}]");
        assertThat(Siphons.minimalTraps(net).sets()).hasToString("[{a}, {b}]");
    }

    @Test
    void placeSet_countsTokensAndRefusesForeignPlaces() {
        var net = small();
        var set = PlaceSet.of(net, "a", "b", "d");

        assertThat(set.tokens(net.initialMarking())).isEqualTo(2);
        assertThat(set.isMarked(net.marking("c"))).isFalse();
        assertThat(set.contains(net.place("a"))).isTrue();
        assertThat(set.contains(net.place("c"))).isFalse();
        assertThat(set.containsAll(PlaceSet.of(net, "a", "d"))).isTrue();
        assertThat(PlaceSet.of(net, "a", "d").containsAll(set)).isFalse();
        var foreign = PaperNets.robot().place("R1");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> PlaceSet.of(net, List.of(foreign)))
                .withMessage("place R1 is not of net small");
    }
}
