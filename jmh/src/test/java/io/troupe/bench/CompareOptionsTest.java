package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class CompareOptionsTest {
    @Test
    void noOption_comparesAllInEverything() {
        var options = CompareOptions.parse();
        assertThat(options.contenders()).isEqualTo(Contenders.labels());
        assertThat(options.workloads()).containsExactly(Workload.values());
    }

    @Test
    void only_addsTheLimitFirst() {
        assertThat(CompareOptions.parse("--only", "vertx,limit,troupe").contenders())
                .containsExactly("limit", "vertx", "troupe");
    }

    @Test
    void allOptions_areRead() {
        var options = CompareOptions.parse(
                "--rounds",
                "3",
                "--warm-up",
                "50",
                "--seed",
                "9",
                "--only",
                "limit",
                "--workloads",
                "tell,create",
                "--figure",
                "a.svg");
        assertThat(options)
                .isEqualTo(new CompareOptions(
                        3, 50, 9, List.of("limit"), List.of(Workload.TELL, Workload.CREATE), Path.of("a.svg")));
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--rounds 0 | --rounds is 0, expected 1 or more",
                "--rounds | an option has no value: --rounds",
                "--only erlang | no contender erlang, there are [limit, troupe",
                "--workloads nap | no workload nap",
                "--fast yes | no option --fast"
            })
    void wrongOption_isNamed(String line, String message) {
        assertThatThrownBy(() -> CompareOptions.parse(line.split(" ")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining(message);
    }
}
