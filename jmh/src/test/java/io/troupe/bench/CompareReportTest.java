package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.DoubleStream;
import org.junit.jupiter.api.Test;

class CompareReportTest {
    /** Each round is twice the limit of that round, whatever the machine did meanwhile. */
    private final Results results = new Results(
            new EnumMap<>(Map.of(
                    Workload.ASK_ONCE,
                    limitAndTroupe(),
                    Workload.TELL,
                    limitAndTroupe(),
                    Workload.CREATE,
                    limitAndTroupe())),
            Map.of("troupe", 80.4));

    private final String table = new CompareReport(CompareOptions.parse("--rounds", "3"), results).table();
    private final String drawing = new CompareDrawing(results).svg();

    private static Map<String, List<Turn>> limitAndTroupe() {
        return new TreeMap<>(Map.of("limit", turns(0, 10, 30, 1_000), "troupe", turns(1_032, 20, 60, 2_000)));
    }

    /** The middle one allocates so many bytes, the others less and more. */
    private static List<Turn> turns(double bytes, double... nanos) {
        return DoubleStream.of(nanos)
                .mapToObj(each -> new Turn(each, bytes + Math.signum(each - nanos[1])))
                .toList();
    }

    @Test
    void table_givesTheRatioWithinTheSameRoundAndTheMedianOfTheBytes() {
        assertThat(table)
                .contains("| tell | troupe | 60.0 (40.0..1,030) | 2.00 (2.00..2.00) | 1,032 |  |")
                .contains("| tell | limit | 30.0 (20.0..515) | 1.00 (1.00..1.00) | 0 |  |");
    }

    @Test
    void table_givesRetainedBytesOfActorsOnly_andOnlyIfMeasured() {
        assertThat(table)
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
    void drawing_hasABarForEveryContender() {
        assertThat(drawing).startsWith("<svg").contains(">tell<", ">limit<", ">troupe<", ">2.00<", "class='m'");
    }

    @Test
    void drawing_showsWakeUpsLastAndWithoutColours() {
        int wakeUps = drawing.indexOf(">askOnce (wake-up of a thread, not ranked)<");
        assertThat(wakeUps).isGreaterThan(drawing.indexOf(">create<"));
        assertThat(drawing.substring(wakeUps)).contains("class='u'").doesNotContain("class='m'", "class='b'");
    }
}
