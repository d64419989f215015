package io.troupe.sim.scenario;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SuggestionsTest {
    @ParameterizedTest
    @CsvSource({"size,size,0", "siez,size,1", "sze,size,1", "sizes,size,1", "pose,size,3", "'',ab,2", "abc,'',3"})
    void slips_countLettersLostAddedChangedOrSwapped(String from, String to, int slips) {
        assertThat(Suggestions.slips(from, to)).isEqualTo(slips);
        assertThat(Suggestions.slips(to, from)).isEqualTo(slips);
    }

    @Test
    void nearest_ofSeveral_isTheOneWithFewestSlips() {
        assertThat(Suggestions.nearest("Positon", List.of("pose", "position", "positions")))
                .isEqualTo("position");
    }

    @Test
    void nearest_whenNothingIsNear_isEmpty() {
        assertThat(Suggestions.nearest("wall", List.of("position", "size"))).isEmpty();
        assertThat(Suggestions.of("wall", List.of("size", "pose"))).isEqualTo("; known: pose, size");
    }
}
