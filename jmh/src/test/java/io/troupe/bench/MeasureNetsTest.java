package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.tools.Thorough;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;

class MeasureNetsTest {
    @Test
    void row_hasWhatWasFound_afterWarmUpsAndRuns() {
        var runs = new AtomicInteger();
        var task = new MeasureNets.NetTask("count", () -> {
            runs.incrementAndGet();
            return new MeasureNets.NetTask.Found(12_345, "markings", "none dead", runs);
        });

        var row = MeasureNets.measure(task, 3, 2);

        assertThat(runs).hasValue(3 + 2);
        assertThat(row).startsWith("| count | 12,345 markings; none dead | ");
    }

    /** Those of more than a second only if tests are thorough. */
    @Test
    void tasks_findTheKnownNumbers() {
        assertThat(MeasureNets.NetTask.all())
                .filteredOn(task -> !task.name().contains("full graph"))
                .filteredOn(task -> Thorough.on() || !NetTable.LONG.contains(task.name()))
                .extracting(task -> task.work().get())
                .extracting(found -> found.items() + " " + found.unit() + "; " + found.text())
                .contains("78130 markings; 1458 dead, COMPLETE", "44 siphons; all of them", "48 siphons; all of them")
                .anyMatch(text -> !Thorough.on() || text.endsWith("Deadlock, 1458 dead; proposal Proved"));
    }

    @Test
    void rowsOfTwoBuilds_areTasks_quickAndLongOnesToo() {
        assertThat(new NetTable().rows())
                .extracting(BuildTable.Row::name)
                .hasSameSizeAs(MeasureNets.NetTask.all())
                .containsAll(NetTable.QUICK)
                .containsAll(NetTable.LONG);
    }

    @Test
    void arguments_thatAreWrong_areRefused() {
        assertThat(BenchmarkTests.parsed(new MeasureNets()).repetitions).isEqualTo(7);
        assertThat(BenchmarkTests.parsed(new MeasureNets(), "--repetitions", "3").repetitions)
                .isEqualTo(3);
        assertThat(errorOf("--repetitions", "0")).startsWith("--repetitions is 0, expected 1 or more");
        assertThat(errorOf("--repetitions", "many")).startsWith("--repetitions is many, expected a whole number");
        assertThat(errorOf("--runs")).contains("'--runs'", "--repetitions=N");
    }

    private static String errorOf(String... arguments) {
        return BenchmarkTests.errorOf(new MeasureNets(), arguments);
    }
}
