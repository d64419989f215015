package io.troupe.bench.worlds;

import static io.troupe.bench.BenchmarkTests.assertDocumented;
import static io.troupe.bench.BenchmarkTests.documentedRows;
import static io.troupe.bench.BenchmarkTests.number;
import static io.troupe.bench.BenchmarkTests.quartiles;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.tools.SampleStatistics;
import java.io.IOException;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.DoubleStream;
import org.junit.jupiter.api.Test;

class WorldsReportTest {
    /**
     * The other contender is half as fast as ours in each round, although the machine's speed changes between rounds.
     */
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
        assertThat(new WorldsReport(BuildScene.FULL, 3, 500, 1, results).table())
                .contains("| 2 | troupe | 200 (150..300) | 1.00 (1.00..1.00) | 2,000 |  |")
                .contains("| 2 | jbox2d | 100 (75.0..150) | 0.500 (0.500..0.500) | 1,000 |  |")
                .contains("| 10,000 | troupe | 0.700 (0.650..0.750) | 1.00 (1.00..1.00) | 7 | 1,234 |")
                .contains("| 10,000 | jbox2d | 0.040 (0.040..0.040) | 0.050 (0.050..0.050) | 0 |  |");
    }

    @Test
    void drawing_saysWhatItFound_withACurveForEachContender_andALineAtRealTime() {
        String title = "Troupe simulates 2 robots 200 times as fast as real time on one thread";
        assertThat(WorldsDrawing.of(results).svg())
                .startsWith("<svg")
                .contains(">troupe, one thread<", ">jbox2d<", ">real time<", ">10,000<")
                .contains("role='img' aria-label='" + title + "'", "<title>Troupe simulates 2 robots 200 times")
                .contains(">simulated seconds per second<", ">number of robots<")
                .doesNotContain(">dyn4j<");
    }

    @Test
    void drawingInTheDocumentation_isThatOfTheTableThere() throws IOException {
        var factors = new TreeMap<Integer, Map<WorldKind, SampleStatistics>>();
        for (var row :
                documentedRows("\\| ([\\d,]+) \\| (\\S+) \\| ([\\d,.]+) \\(([\\d,.]+?)\\.\\.([\\d,.]+)\\) \\|.*")) {
            if (WorldKind.labels().contains(row.group(2))) {
                factors.computeIfAbsent((int) number(row.group(1)), robots -> new EnumMap<>(WorldKind.class))
                        .put(WorldKind.named(row.group(2)), quartiles(row, 3));
            }
        }
        assertThat(factors).hasSize(6);
        assertDocumented("worlds.svg", new WorldsDrawing(factors).svg());
    }
}
