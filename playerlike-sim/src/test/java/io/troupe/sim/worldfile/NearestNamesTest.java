package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class NearestNamesTest {
    @ParameterizedTest
    @CsvSource({"size,size,0", "siez,size,1", "sze,size,1", "sizes,size,1", "pose,size,3", "'',ab,2", "abc,'',3"})
    void slips_countLettersLostAddedChangedOrSwapped(String from, String to, int slips) {
        assertThat(NearestNames.slips(from, to)).isEqualTo(slips);
        assertThat(NearestNames.slips(to, from)).isEqualTo(slips);
    }

    @Test
    void nearest_ofSeveral_isTheOneWithFewestSlips() {
        assertThat(NearestNames.nearest("Positon", List.of("pose", "position", "positions")))
                .isEqualTo("position");
    }

    @Test
    void nearest_whenNothingIsNear_isEmpty() {
        assertThat(NearestNames.nearest("wall", List.of("position", "size"))).isEmpty();
        assertThat(NearestNames.of("wall", List.of("size", "pose"))).isEqualTo("; known: pose, size");
    }
}
