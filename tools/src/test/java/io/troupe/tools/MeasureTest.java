package io.troupe.tools;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.lang.ref.Reference;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.Test;

/** The statistics of samples, compared with values calculated by hand; the used heap; the progress line. */
class MeasureTest {
    private static final int BYTES = 16 << 20;
    private static final int COLUMNS = 20;

    private final ByteArrayOutputStream bytes = new ByteArrayOutputStream();
    private final PrintStream stream = new PrintStream(bytes, true, StandardCharsets.UTF_8);
    private long nanos;
    private final ProgressLine line = ProgressLine.onTerminal(stream, () -> nanos, COLUMNS);

    @Test
    void statistics_haveTheirQuartilesBetweenTheValues() {
        var spread = SampleStatistics.of(5, 1, 4, 2, 3);
        assertThat(spread).isEqualTo(new SampleStatistics(3, 2, 4, 1, 5, 5));
        assertThat(spread.halfWidth()).isEqualTo(1);
        assertThat(SampleStatistics.of(1, 2, 3, 10)).isEqualTo(new SampleStatistics(2.5, 1.75, 4.75, 1, 10, 4));
        assertThat(SampleStatistics.of(7)).isEqualTo(new SampleStatistics(7, 7, 7, 7, 7, 1));
        assertThat(SampleStatistics.of(List.of(8.0, 4.0))).isEqualTo(new SampleStatistics(6, 5, 7, 4, 8, 2));
        assertThatThrownBy(() -> SampleStatistics.of()).hasMessage("0 values, expected at least one");
        assertThatThrownBy(() -> SampleStatistics.of(1, Double.NaN)).hasMessageContaining("a value is NaN");
    }

    @Test
    void statisticsText_leavesQuartilesOutThatNobodySees() {
        assertThat(SampleStatistics.of(1, 2, 3).text(1)).isEqualTo("2.0 (1.5..2.5)");
        assertThat(SampleStatistics.of(2.001, 2.002, 2.003).text(1)).isEqualTo("2.0");
        assertThat(SampleStatistics.of(2, 2, 2).text(value -> "<" + value + ">"))
                .isEqualTo("<2.0> (<2.0>..<2.0>)");
    }

    @Test
    void usedHeap_countsWhatIsKept_andNoGarbage() throws InterruptedException {
        long before = UsedHeap.bytes();
        var kept = new byte[BYTES];
        var garbage = kept.clone();
        assertThat(garbage).hasSize(BYTES);
        garbage = null;
        assertThat(UsedHeap.bytes() - before).isBetween((long) (0.5 * BYTES), (long) (1.5 * BYTES));
        assertThat(UsedHeap.bytes(Duration.ofMillis(1)) - before).isBetween((long) (0.5 * BYTES), (long) (1.5 * BYTES));
        Reference.reachabilityFence(kept);
    }

    private String written() {
        String text = bytes.toString(StandardCharsets.UTF_8);
        bytes.reset();
        return text;
    }

    @Test
    void line_isWrittenAFewTimesASecond_howeverOftenItIsShown() {
        for (int tick = 0; tick < 1000; tick++) { // ten seconds
            line.show("run", "tick " + tick);
            nanos += Duration.ofMillis(10).toNanos();
        }
        assertThat(written().split("\r", -1)).hasSizeBetween(10, 10 * 4 + 2);
    }

    @Test
    void nextStage_isShownAtOnce_butATextThatDiffersInItsNumbersOnlyIsNone() {
        line.show("one", "one 1");
        line.show("one", "one 2");
        line.show("two", "two 1");
        assertThat(written()).isEqualTo("\rone 1\033[K\rtwo 1\033[K");
        line.show("net: 10,000 markings");
        line.show("net: 20,000 markings");
        assertThat(written()).contains("10,000").doesNotContain("20,000");
    }

    @Test
    void line_isNoWiderThanTheTerminal() {
        line.show("x".repeat(3 * COLUMNS));
        assertThat(written()).isEqualTo("\r" + "x".repeat(COLUMNS - 1) + "\033[K");
    }

    @Test
    void interrupt_wipesWhatWasShown_andWhatComesNextIsShownAtOnce() {
        line.show("run", "1");
        line.interrupt(() -> stream.print("change\n"));
        line.show("run", "2");
        assertThat(written()).isEqualTo("\r1\033[K\r\033[Kchange\n\r2\033[K");
    }

    @Test
    void offATerminal_aPlainLineIsPrintedNowAndThen_withoutEscapes() {
        var plain = ProgressLine.plain(stream, () -> nanos, Duration.ofSeconds(10));
        for (int second = 0; second < 25; second++) {
            plain.show("run", second + " s");
            nanos += Duration.ofSeconds(1).toNanos();
        }
        plain.close();
        assertThat(written().lines()).containsExactly("troupe: 10 s", "troupe: 20 s");
        assertThat(ProgressLine.knowsEscapes("dumb")).isFalse();
        assertThat(ProgressLine.knowsEscapes("xterm-256color")).isTrue();
        assertThat(ProgressLine.knowsEscapes(null)).isTrue(); // as on Windows
    }

    @Test
    void bar_isFilledUpToTheShare() {
        assertThat(ProgressLine.bar(0)).isEqualTo("[" + ".".repeat(30) + "]");
        assertThat(ProgressLine.bar(0.5)).isEqualTo("[" + "#".repeat(15) + ".".repeat(15) + "]");
        assertThat(ProgressLine.bar(1)).isEqualTo("[" + "#".repeat(30) + "]");
    }
}
