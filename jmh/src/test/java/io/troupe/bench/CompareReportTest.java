package io.troupe.bench;

import static io.troupe.bench.BenchmarkTests.assertDocumented;
import static io.troupe.bench.BenchmarkTests.documentedRows;
import static io.troupe.bench.BenchmarkTests.quartiles;
import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.util.EnumMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.DoubleStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

class CompareReportTest {
    /** Each round is twice the limit of that round, although the machine's speed changes between rounds. */
    private final Map<String, List<TurnResult>> turns =
            new TreeMap<>(Map.of("limit", turns(0, 10, 30, 1_000), "troupe", turns(1_032, 20, 60, 2_000)));

    private final Results results = new Results(
            new EnumMap<>(Map.of(Workload.ASK_ONCE, turns, Workload.TELL, turns, Workload.CREATE, turns)),
            Map.of("troupe", 80.4));
    private final String table = new CompareReport(3, 1, results).table();
    private final String drawing = CompareDrawing.of(results).svg();

    /** The turn in the middle allocates {@code bytes}, the others less and more. */
    private static List<TurnResult> turns(double bytes, double... nanos) {
        return DoubleStream.of(nanos)
                .mapToObj(each -> new TurnResult(each, bytes + Math.signum(each - nanos[1])))
                .toList();
    }

    @Test
    void table_givesTheRatioWithinTheSameRound_theMedianOfTheBytes_andRetainedBytesOfActorsIfMeasured() {
        assertThat(table)
                .contains("| tell | troupe | 60.0 (40.0..1,030) | 2.00 (2.00..2.00) | 1,032 |  |")
                .contains("| tell | limit | 30.0 (20.0..515) | 1.00 (1.00..1.00) | 0 |  |")
                .contains("| create | troupe | 60.0 (40.0..1,030) | 2.00 (2.00..2.00) | 1,032 | 80 |")
                .contains("| create | limit | 30.0 (20.0..515) | 1.00 (1.00..1.00) | 0 |  |");
    }

    @Test
    void table_keepsWakeUpsApart() {
        assertThat(table.indexOf("not ranked"))
                .isGreaterThan(table.indexOf("| create | troupe"))
                .isBetween(0, table.indexOf("| askOnce | limit"));
        assertThat(table.split("\\| workload \\|")).hasSize(3);
    }

    @Test
    void drawing_hasABarForEveryContender_andShowsWakeUpsLastAndWithoutColours() {
        assertThat(drawing).startsWith("<svg");
        assertThat(drawing).contains(">tell<", ">limit<", ">troupe<", ">60.0 ns, 2.00×<", "class='m'");
        int wakeUps = drawing.indexOf(">askOnce (wake-up of a thread, not ranked)<");
        assertThat(wakeUps).isGreaterThan(drawing.indexOf(">create<"));
        assertThat(drawing.substring(wakeUps)).contains("class='u'").doesNotContain("class='m'", "class='b'");
    }

    @Test
    void drawing_saysWhatItFound_andThatShorterIsBetter_inTwoColumns() {
        String title =
                "In this run Troupe has the lowest median time per operation in 2 of 2 workloads, limit and floor apart";
        assertThat(drawing).contains("role='img' aria-label='" + title + "'", "<title>" + title + "</title>");
        assertThat(drawing).contains("shorter is better");
        assertThat(drawing.split("<text x='16' y='\\d+' class='t'>", -1)).hasSize(1 + 2);
        assertThat(drawing.split("<text x='524' y='\\d+' class='t'>", -1)).hasSize(1 + 1);
    }

    @Test
    void drawingInTheDocumentation_isThatOfTheTableThere() throws IOException {
        String spread = "([\\d,.]+) \\(([\\d,.]+?)\\.\\.([\\d,.]+)\\)";
        var labels = Stream.of(Workload.values()).map(Workload::label).toList();
        var bars = new EnumMap<Workload, Map<String, CompareDrawing.Bar>>(Workload.class);
        for (var row : documentedRows("\\| (\\S+) \\| (\\S+) \\| " + spread + " \\| " + spread + " \\|.*")) {
            if (labels.contains(row.group(1))) {
                bars.computeIfAbsent(Workload.named(row.group(1)), workload -> new LinkedHashMap<>())
                        .put(row.group(2), new CompareDrawing.Bar(quartiles(row, 3), quartiles(row, 6)));
            }
        }
        assertThat(bars).hasSize(9);
        assertThat(bars.values()).allMatch(its -> its.size() == Contenders.values().length);
        assertDocumented("actors.svg", new CompareDrawing(bars).svg());
    }
}
