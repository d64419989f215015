package io.troupe.bench.bus;

import static io.troupe.bench.BenchmarkTests.assertDocumented;
import static io.troupe.bench.BenchmarkTests.documentedRows;
import static io.troupe.bench.BenchmarkTests.number;
import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.util.Arrays;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.stream.DoubleStream;
import org.junit.jupiter.api.Test;

class BusReportTest {
    /** We take twice as long as the other in each round, although the machine's speed changes between rounds. */
    private final BusResults results = new BusResults(
            new EnumMap<>(Map.of(
                    BusWorkload.ENCODE_SONAR,
                    Map.of(BusContender.TROUPE, means(0.2, 0.6, 0.4), BusContender.JACKSON, means(0.1, 0.3, 0.2)),
                    BusWorkload.ASK_64,
                    Map.of(
                            BusContender.TROUPE,
                            spreads(200, 600, 400),
                            BusContender.ACTOR,
                            spreads(300, 900, 600),
                            BusContender.RAW,
                            spreads(100, 300, 200)),
                    BusWorkload.PUBLISH,
                    Map.of(BusContender.TROUPE, means(10, 20, 40), BusContender.RAW, means(5, 10, 20)))),
            new EnumMap<>(Map.of(
                    BusWorkload.ENCODE_SONAR,
                    Map.of(BusContender.TROUPE, 171.0, BusContender.JACKSON, 172.0),
                    BusWorkload.ASK_64,
                    Map.of(BusContender.TROUPE, 130.0, BusContender.ACTOR, 180.0, BusContender.RAW, 130.0),
                    BusWorkload.PUBLISH,
                    Map.of(BusContender.TROUPE, 230.0, BusContender.RAW, 230.0))),
            new EnumMap<>(Map.of(BusResults.Node.ALONE, new BusMemory.Cost(54_321.4, 5.95))));

    private static List<BusTurn> means(double... micros) {
        return DoubleStream.of(micros)
                .mapToObj(each -> new BusTurn(List.of(each), 3, 1_234))
                .toList();
    }

    /** Times that grow from p1 to p99.9. */
    private static List<BusTurn> spreads(double... medians) {
        return DoubleStream.of(medians)
                .mapToObj(median -> new BusTurn(
                        BusTurn.SHARES.stream().map(share -> 2 * median * share).toList(), 50, 1_234))
                .toList();
    }

    @Test
    void tables_divideByTheOtherOfTheSameRound() {
        assertThat(new BusReport(results).tables())
                .contains("| sonar, encode | troupe | 400 (300..500) | 2.00 (2.00..2.00) | 171 | 1,234 |")
                .contains("| sonar, encode | jackson | 200 (150..250) |  | 172 | 1,234 |")
                .contains("| 64 bytes | troupe | 400 (300..500) | 792 (594..990) | 2.00 (2.00..2.00) "
                        + "| 2.00 (2.00..2.00) | 50.0 | 1,234 | 130 |")
                .contains("| 64 bytes | raw-nats | 4.00 | 20.0 | 40.0 | 100 | 200 | 300 | 360 | 380 | 396 | 400 |")
                .contains(
                        "| sonar records | troupe | 50,000 (37,500..75,000) | 0.50 (0.50..0.50) | 3.00 | 1,234 | 230 |")
                .contains("| 64 bytes | troupe-actor | 600 (450..750) | 1,188 (891..1,485) | 3.00 (3.00..3.00) "
                        + "| 3.00 (3.00..3.00) | 50.0 | 1,234 | 180 |")
                .contains("| without connection | 54,321 | 6 |")
                .doesNotContain("1,000 bytes");
    }

    @Test
    void tables_haveAsManyCellsInEachRowAsInTheHead() {
        for (String table : new BusReport(results).tables().strip().split("\n\\s*\n")) {
            assertThat(Arrays.stream(table.strip().split("\n"))
                            .map(row -> row.chars().filter(each -> each == '|').count())
                            .distinct())
                    .as(table)
                    .hasSize(1);
        }
    }

    @Test
    void drawing_saysWhatItFound_andHasACurveForEachContender() {
        assertThat(BusDrawing.of(results).svg())
                .startsWith("<svg")
                .contains("Half of the requests over our bus take at most 400 us, by NATS itself 200 us")
                .contains(
                        ">troupe, 64 bytes<",
                        ">troupe-actor, 64 bytes<",
                        ">raw-nats, 64 bytes<",
                        ">p1<",
                        ">p99.9<",
                        ">1,000<",
                        ">5<")
                .doesNotContain("1,000 bytes");
    }

    @Test
    void drawingInTheDocumentation_isThatOfTheTableThere() throws IOException {
        var micros = new EnumMap<BusWorkload, Map<BusContender, List<Double>>>(BusWorkload.class);
        for (var row : documentedRows("\\| ([\\d,]+ bytes) \\| (\\S+) ((?:\\| [\\d,.]+ ){10})\\|")) {
            for (BusWorkload workload : BusWorkload.Part.ASK.workloads()) {
                if (workload.label().equals(row.group(1))) {
                    micros.computeIfAbsent(workload, each -> new EnumMap<>(BusContender.class))
                            .put(BusContender.named(row.group(2)), numbers(row.group(3)));
                }
            }
        }
        assertThat(micros)
                .hasSize(2)
                .allSatisfy((workload, contenders) -> assertThat(contenders).hasSize(3));
        assertDocumented("buses.svg", new BusDrawing(micros).svg());
    }

    private static List<Double> numbers(String cells) {
        return Arrays.stream(cells.substring(2).split(" \\| "))
                .map(cell -> number(cell.strip()))
                .toList();
    }
}
