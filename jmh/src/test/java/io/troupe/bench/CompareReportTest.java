package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.junit.jupiter.api.Test;

class CompareReportTest {
    /** Each round is twice the limit of that round, whatever the machine did meanwhile. */
    private final CompareReport report = new CompareReport(
            CompareOptions.parse("--rounds", "3"),
            Map.of(
                    Workload.TELL,
                    new TreeMap<>(
                            Map.of("limit", List.of(10.0, 30.0, 1_000.0), "troupe", List.of(20.0, 60.0, 2_000.0)))));

    @Test
    void table_givesTheRatioWithinTheSameRound() {
        assertThat(report.table())
                .contains("| tell | troupe | 60.0 (40.0..1,030) | 2.00 (2.00..2.00) |")
                .contains("| tell | limit | 30.0 (20.0..515) | 1.00 (1.00..1.00) |");
    }

    @Test
    void drawing_hasABarForEveryContender() {
        assertThat(report.drawing()).startsWith("<svg").contains(">tell<", ">limit<", ">troupe<", ">2.00<");
    }
}
