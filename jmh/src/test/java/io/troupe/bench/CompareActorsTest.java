package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class CompareActorsTest {
    private static CompareActors parsed(String... arguments) {
        return BenchmarkTests.parsed(new CompareActors(), arguments);
    }

    @Test
    void noOption_comparesAllInEverything() {
        var options = parsed();
        assertThat(options.contenders()).containsExactly(Contenders.values());
        assertThat(options.workloads).containsExactly(Workload.values());
        assertThat(options)
                .extracting(
                        each -> each.comparison.rounds,
                        each -> each.comparison.warmUpMillis,
                        each -> each.comparison.seed,
                        each -> each.comparison.figure)
                .containsExactly(20, 2_000, 1L, null);
    }

    @Test
    void only_addsTheLimitFirst_andTheLastOfEqualOptionsCounts() {
        assertThat(parsed("--only", "vertx,limit,troupe").contenders())
                .containsExactly(Contenders.LIMIT, Contenders.VERTX, Contenders.TROUPE);
        assertThat(parsed("--rounds", "3", "--rounds", "4").comparison.rounds).isEqualTo(4);
    }

    @Test
    void allOptions_areRead() {
        String line = "--rounds 3 --warm-up 50 --seed -9 --only limit --workloads tell,create --figure a.svg";
        var options = parsed(line.split(" "));
        assertThat(options.contenders()).containsExactly(Contenders.LIMIT);
        assertThat(options.workloads).containsExactly(Workload.TELL, Workload.CREATE);
        assertThat(options)
                .extracting(
                        each -> each.comparison.rounds,
                        each -> each.comparison.warmUpMillis,
                        each -> each.comparison.seed,
                        each -> each.comparison.figure)
                .containsExactly(3, 50, -9L, Path.of("a.svg"));
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--rounds 0 | --rounds is 0, expected 1 or more",
                "--warm-up soon | --warm-up is soon, expected a whole number",
                "--seed 1.5 | --seed is 1.5, expected a whole number",
                "--rounds | Missing required parameter for option '--rounds' (N)",
                "--only erlang | --only is erlang, expected one of limit, floor, troupe, executor",
                "--only limit,erlang | --only is erlang, expected one of limit, floor, troupe, executor",
                "--workloads nap | --workloads is nap, expected one of tell, tellFromFour",
                "--fast yes | '--fast'"
            })
    void wrongOption_isNamed_withItsValueAndWhatWasExpected_beforeTheUsage(String line, String message) {
        assertThat(BenchmarkTests.errorOf(new CompareActors(), line.split(" ")))
                .contains(message)
                .contains("Usage: CompareActors");
    }
}
