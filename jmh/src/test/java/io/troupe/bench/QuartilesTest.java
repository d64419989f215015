package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;

class QuartilesTest {
    @Test
    void fiveValues_inAnyOrder_haveTheirQuartilesAmongThem() {
        assertThat(Quartiles.of(List.of(50.0, 10.0, 40.0, 20.0, 30.0))).isEqualTo(new Quartiles(20, 30, 40));
    }

    @Test
    void twoValues_areInterpolated() {
        assertThat(Quartiles.of(List.of(4.0, 8.0))).isEqualTo(new Quartiles(5, 6, 7));
    }

    @Test
    void oneValue_isItsOwnQuartiles() {
        assertThat(Quartiles.of(List.of(7.0))).isEqualTo(new Quartiles(7, 7, 7));
    }
}
