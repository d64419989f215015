package io.troupe.common.text;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SuggestionsTest {
    private static final List<String> KNOWN = List.of("player", "spaceWanderer", "wallFollower", "map");
    private static final List<String> NONE = List.of();

    private static List<String> numbered(int count) {
        return IntStream.range(0, count)
                .mapToObj(i -> "n" + (char) ('a' + count - i))
                .toList();
    }

    @ParameterizedTest
    @CsvSource({
        "spaceWandrer, spaceWanderer", // omitted
        "spaceWaanderer, spaceWanderer", // added
        "spaceWonderer, spaceWanderer", // changed
        "paceWanderres, spaceWanderer", // omitted at the start, swapped with its neighbour at the end
        "PLAYER, player",
        "mpa, map",
        "camera, ''", // from here on: more slips than a third
        "m, ''",
        "wander, ''",
        "wallClimber, ''"
    })
    void name_withFewEdits_isFound_withMoreThanAThirdItIsNot(String written, String meant) {
        assertThat(Suggestions.nearest(written, KNOWN).orElse("")).isEqualTo(meant);
    }

    @Test
    void nearerName_wins_andTheFirstOfEquals_longOrEmptyTextHasNone() {
        assertThat(Suggestions.nearest("robot3", List.of("robots", "robot1", "robot3x")))
                .contains("robots");
        assertThat(Suggestions.nearest("robot", List.of("robat2", "robat"))).contains("robat");
        assertThat(Suggestions.nearest("Positon", List.of("pose", "position", "positions")))
                .contains("position");
        assertThat(Suggestions.nearest("a".repeat(101), List.of("a".repeat(101))))
                .isEmpty();
        assertThat(Suggestions.nearest("", NONE)).isEmpty();
        assertThat(Suggestions.nearest("a", List.of(""))).isEmpty();
    }

    @ParameterizedTest
    @CsvSource({
        "size,size,0,0",
        "siez,size,1,2",
        "sze,size,1,1",
        "sizes,size,1,1",
        "pose,size,3,3",
        "'',ab,2,2",
        "abc,'',3,3",
        "setValue,setValues,1,1",
        "kitten,sitting,3,3"
    })
    void distance_countsEdits(String one, String other, int edits, int editsWithSwapAsTwo) {
        assertThat(Suggestions.distance(one, other, 1)).isEqualTo(edits);
        assertThat(Suggestions.distance(other, one, 1)).isEqualTo(edits);
        assertThat(Suggestions.distance(one, other, 2)).isEqualTo(editsWithSwapAsTwo);
        assertThat(Suggestions.distance(other, one, 2)).isEqualTo(editsWithSwapAsTwo);
    }

    @Test
    void hint_hasTheNearestName_orTheFirstEight_withSomeTheFirstTwelve() {
        assertThat(Suggestions.hint("mapp", KNOWN)).isEqualTo("did you mean map?");
        assertThat(Suggestions.hint("xyz", List.of("b", "a"))).isEqualTo("there are a, b");
        assertThat(Suggestions.hint("xyz", numbered(9))).isEqualTo("there are nb, nc, nd, ne, nf, ng, nh, ni, ..");
        assertThat(Suggestions.hint("xyz", NONE)).isEqualTo("there is none");
        assertThat(Suggestions.hintWithSome("mapp", List.of("map", "ape")))
                .isEqualTo("did you mean \"map\"? expected one of ape, map");
        assertThat(Suggestions.hintWithSome("xyz", numbered(13)))
                .isEqualTo("expected one of nb, nc, nd, ne, nf, ng, nh, ni, nj, nk, nl, nm, ..");
        assertThat(Suggestions.hintWithSome("xyz", NONE)).isEqualTo("there is none");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "ab | xy b | did you mean b? known: xy, b",
                "ab | xy | did you mean xy? known: xy",
                "player3 | player2 player1 | did you mean player1? known: player2, player1",
                "xyz | player spaceWanderer wallFollower map | known: player, spaceWanderer, wallFollower, map",
                "acb | cabx abc | did you mean abc? known: cabx, abc"
            })
    void hintWithAll_keepsTheOrder_acceptsTwoEdits_andPrefersTheFirstByName(String text, String known, String hint) {
        assertThat(Suggestions.hintWithAll(text, List.of(known.split(" ")))).isEqualTo(hint);
    }

    @Test
    void hintWithAll_ofNone_orOfLongNames() {
        assertThat(Suggestions.hintWithAll("xyz", NONE)).isEqualTo("there are none");
        assertThat(Suggestions.hintWithAll("a".repeat(101), List.of("a".repeat(102))))
                .startsWith("did you mean aaa");
    }

    @Test
    void clauses_haveTheNearestName_allNames_orTheNamesThatBeginSo() {
        List<String> known = List.of("size", "pose");
        assertThat(Suggestions.clause("siez", known)).isEqualTo("; did you mean \"size\"?");
        assertThat(Suggestions.clause("wall", known)).isEmpty();
        assertThat(Suggestions.clauseOrAll("siez", known)).isEqualTo("; did you mean \"size\"?");
        assertThat(Suggestions.clauseOrAll("wall", known)).isEqualTo("; known: pose, size");
        assertThat(Suggestions.clauseOrAll("wall", NONE)).isEqualTo("; known: none");
        assertThat(Suggestions.clauseWithAll("siez", known)).isEqualTo("; did you mean \"size\"? known: pose, size");
        assertThat(Suggestions.clauseWithAll("wall", known)).isEqualTo("; known: pose, size");
        List<String> commands = List.of("run", "evaluate");
        assertThat(Suggestions.clauseForArgument("rnu", commands)).isEqualTo("; did you mean run?");
        assertThat(Suggestions.clauseForArgument("eval", commands)).isEqualTo("; did you mean evaluate?");
        assertThat(Suggestions.clauseForArgument("ev", commands)).isEqualTo("; there are run, evaluate");
        assertThat(Suggestions.clauseForArgument("--xyz", List.of("--seed"))).isEmpty();
        assertThat(Suggestions.expected("one of", "neer", List.of("near", "far")))
                .isEqualTo(", expected one of: near, far (did you mean 'near'?)");
        assertThat(Suggestions.expected("words", "x", List.of("near"))).isEqualTo(", expected words: near");
        assertThat(Suggestions.expected("words", "", NONE)).isEqualTo(", expected words: none is known");
    }
}
