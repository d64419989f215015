package io.troupe.bench.worlds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.bench.Quartiles;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.Pattern;
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
        assertThat(new WorldsReport(WorldsOptions.parse("--rounds", "3"), results).table())
                .contains("| 2 | troupe | 200 (150..300) | 1.00 (1.00..1.00) | 2,000 |  |")
                .contains("| 2 | jbox2d | 100 (75.0..150) | 0.500 (0.500..0.500) | 1,000 |  |")
                .contains("| 10,000 | troupe | 0.700 (0.650..0.750) | 1.00 (1.00..1.00) | 7 | 1,234 |")
                .contains("| 10,000 | jbox2d | 0.040 (0.040..0.040) | 0.050 (0.050..0.050) | 0 |  |");
    }

    @Test
    void drawing_hasACurveForEachContenderAndALineAtRealTime() {
        assertThat(WorldsDrawing.of(results).svg())
                .startsWith("<svg")
                .contains(">troupe, one thread<", ">jbox2d<", ">real time<", ">10,000<")
                .doesNotContain(">dyn4j<");
    }

    @Test
    void drawing_saysWhatItFound_withUnits() {
        assertThat(WorldsDrawing.of(results).svg())
                .contains(
                        "role='img' aria-label='Troupe simulates 2 robots 200 times as fast as real time on one thread'")
                .contains("<title>Troupe simulates 2 robots 200 times", ">simulated seconds per second<")
                .contains(">number of robots<");
    }

    /** {@code -Dfigures=write} writes it anew. */
    @Test
    void drawingInTheDocumentation_isThatOfTheTableThere() throws IOException {
        var row = Pattern.compile("\\| ([\\d,]+) \\| (\\S+) \\| ([\\d,.]+) \\(([\\d,.]+?)\\.\\.([\\d,.]+)\\) \\|.*");
        var factors = new TreeMap<Integer, Map<WorldKind, Quartiles>>();
        for (String line : Files.readAllLines(Path.of("..", "docs", "benchmarks-method.md"))) {
            var found = row.matcher(line);
            if (found.matches() && WorldKind.labels().contains(found.group(2))) {
                factors.computeIfAbsent((int) number(found.group(1)), robots -> new EnumMap<>(WorldKind.class))
                        .put(
                                WorldKind.named(found.group(2)),
                                new Quartiles(number(found.group(4)), number(found.group(3)), number(found.group(5))));
            }
        }
        assertThat(factors).hasSize(6);

        String svg = new WorldsDrawing(factors).svg();
        Path documented = Path.of("..", "docs", "figures", "worlds.svg");
        if ("write".equals(System.getProperty("figures"))) {
            Files.writeString(documented, svg);
        }
        assertThat(documented).hasContent(svg);
    }

    private static double number(String text) {
        return Double.parseDouble(text.replace(",", ""));
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
