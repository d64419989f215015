package io.troupe.common.text;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SuggestionsTest {
    private static final List<String> KNOWN = List.of("player", "spaceWanderer", "wallFollower", "map");

    @ParameterizedTest
    @CsvSource({
        "spaceWandrer, spaceWanderer", // omitted
        "spaceWaanderer, spaceWanderer", // added
        "spaceWonderer, spaceWanderer", // changed
        "paceWanderres, spaceWanderer", // omitted at the start, swapped with its neighbour at the end
        "PLAYER, player",
        "mpa, map"
    })
    void name_withFewEdits_isFound(String written, String meant) {
        assertThat(Suggestions.nearest(written, KNOWN)).contains(meant);
    }

    @ParameterizedTest
    @CsvSource({"camera", "m", "wander", "wallClimber"})
    void name_withMoreSlipsThanAThird_isNot(String written) {
        assertThat(Suggestions.nearest(written, KNOWN)).isEmpty();
    }

    @Test
    void nearerName_wins_andTheFirstOfEquals() {
        assertThat(Suggestions.nearest("robot3", List.of("robots", "robot1", "robot3x")))
                .contains("robots");
        assertThat(Suggestions.nearest("robot", List.of("robat2", "robat"))).contains("robat");
    }

    @Test
    void longText_isNobodysName() {
        assertThat(Suggestions.nearest("a".repeat(101), List.of("a".repeat(101))))
                .isEmpty();
        assertThat(Suggestions.nearest("", List.of())).isEmpty();
    }
}
