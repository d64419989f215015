package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(120)
class MeasureSpacesTest {
    @Test
    void questions_areMeasuredBesideTheBareExchange() throws Exception {
        var measure = BenchmarkTests.parsed(new MeasureSpaces(), "--rounds", "2", "--questions", "3");
        assertThat(measure.compareQuestions())
                .satisfiesExactly(
                        bare -> assertThat(bare).matches("\\| bare exchange of two threads \\| [0-9. ()]+ \\|  \\|"),
                        asked -> assertThat(asked)
                                .matches("\\| actors of two spaces \\| [0-9. ()]+ \\| [0-9. ()]+ \\|"));
    }

    @Test
    void timers_areMeasured() throws Exception {
        assertThat(MeasureSpaces.TimerShare.measure(10, Duration.ofMillis(5), Duration.ofMillis(50)))
                .matches("\\| 5 ms \\| [0-9.]+ % \\| [0-9.]+ \\|");
    }

    @Test
    void arguments_thatAreWrong_areRefused() {
        assertThat(BenchmarkTests.parsed(new MeasureSpaces()).timers).isEqualTo(10_000);
        assertThat(BenchmarkTests.errorOf(new MeasureSpaces(), "--rounds", "0"))
                .startsWith("--rounds is 0, expected 1 or more");
    }
}
