package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.time.ManualClock;
import io.troupe.common.measure.ProgressLine;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.services.subsumption.Mode;
import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import org.junit.jupiter.api.Test;

class EvaluationProgressTest {
    private static final Job JOB = new Job(Kind.ALONE, Mode.SYNC, "wallFollower", 20, 2.5, 7, 0);

    private final ByteArrayOutputStream terminal = new ByteArrayOutputStream();
    private final ManualClock clock = new ManualClock();
    private final PrintStream stream = new PrintStream(terminal, true, StandardCharsets.UTF_8);
    private final EvaluationProgress progress =
            new EvaluationProgress(ProgressLine.on(stream, clock::nanos), clock);

    /** The output since the previous call. */
    private String shown() {
        String text = terminal.toString(StandardCharsets.UTF_8);
        terminal.reset();
        return text.replace("\r", "").replace("\033[K", "");
    }

    private static String bar(int full) {
        return "[" + "#".repeat(full) + ".".repeat(30 - full) + "]";
    }

    @Test
    void progress_isTheShareOfWhatIsExpected_andTheTimeLeftFollowsFromIt() {
        progress.expect(200);
        progress.warmsUp(2);
        assertThat(shown()).isEqualTo(bar(0) + "   0 %  warming up, told 2 cores"); // too early for an estimate
        clock.advance(Duration.ofSeconds(10));
        progress.ended(50);
        progress.begins(JOB, 1);
        String doing = JOB.title() + ", told " + "1 core";
        assertThat(shown()).isEqualTo(bar(7) + "  25 %, 30 s left  " + doing);
        clock.advance(Duration.ofSeconds(10));
        progress.within(50);
        assertThat(shown()).isEqualTo(bar(15) + "  50 %, 20 s left  " + doing);
        progress.ended(100); // includes the progress reported during the job
        clock.advance(Duration.ofSeconds(1)); // a terminal is updated only a few times a second
        progress.begins(JOB, 1);
        assertThat(shown()).isEqualTo(bar(22) + "  75 %, 7 s left  " + doing);
    }

    @Test
    void moreThanWasExpected_isAll() {
        progress.expect(10);
        progress.ended(9);
        progress.within(5);
        assertThat(shown()).startsWith(bar(30) + " 100 %, 0 s left");
        progress.ended(5);
        progress.begins(JOB, 3);
        assertThat(shown()).startsWith(bar(30) + " 100 %, 0 s left").endsWith("told 3 cores");
    }

    @Test
    void close_wipesTheLine() {
        progress.warmsUp(2);
        terminal.reset();
        progress.close();
        assertThat(terminal.toString(StandardCharsets.UTF_8)).isEqualTo("\r\033[K");
    }
}
