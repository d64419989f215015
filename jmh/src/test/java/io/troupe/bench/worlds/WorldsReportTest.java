package io.troupe.bench.worlds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.DoubleStream;
import org.junit.jupiter.api.Test;

class WorldsReportTest {
    /** The peer is half as fast as ours in each round, whatever the machine did meanwhile. */
    private final WorldsResults results = new WorldsResults(
            new TreeMap<>(Map.of(
                    2,
                    new TreeMap<>(
                            Map.of(WorldKind.TROUPE, turns(100, 400, 200), WorldKind.JBOX2D, turns(50, 200, 100))),
                    10_000,
                    new TreeMap<>(Map.of(WorldKind.TROUPE, turns(0.8, 0.6, 0.7), WorldKind.JBOX2D, turns(0.04))))),
            new TreeMap<>(Map.of(10_000, 1_234.4)));

    private static List<WorldTurn> turns(double... factors) {
        return DoubleStream.of(factors)
                .mapToObj(factor -> new WorldTurn(factor, 10 * factor))
                .toList();
    }

    @Test
    void table_dividesByOursOfTheSameRound() {
        assertThat(new WorldsReport(WorldsOptions.parse("--rounds", "3"), results).table())
                .contains("| 2 | troupe | 200 (150..300) | 1.00 (1.00..1.00) | 2,000 |  |")
                .contains("| 2 | jbox2d | 100 (75.0..150) | 0.500 (0.500..0.500) | 1,000 |  |")
                .contains("| 10,000 | troupe | 0.700 (0.650..0.750) | 1.00 (1.00..1.00) | 7 | 1,234 |")
                .contains("| 10,000 | jbox2d | 0.040 (0.040..0.040) | 0.050 (0.050..0.050) | 0 |  |");
    }

    @Test
    void drawing_hasACurveForEachContenderAndALineAtRealTime() {
        assertThat(new WorldsDrawing(results).svg())
                .startsWith("<svg")
                .contains(">troupe<", ">jbox2d<", ">real time<", ">10,000<")
                .doesNotContain(">dyn4j<");
    }

    @Test
    void options_areRead_andWrongOnesRefused() {
        var options = WorldsOptions.parse("--quick", "--robots", "100,2", "--only", "dyn4j");
        assertThat(options.robots()).containsExactly(2, 100);
        assertThat(options.rounds()).isEqualTo(3);
        assertThat(options.only()).containsExactly(WorldKind.TROUPE, WorldKind.DYN4J);
        assertThatIllegalArgumentException()
                .isThrownBy(() -> WorldsOptions.parse("--robots", "0"))
                .withMessage("--robots is 0, expected 1 or more");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> WorldsOptions.parse("--only", "stage"))
                .withMessageStartingWith("no contender stage");
    }
}
