package io.troupe.common.measure;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import org.junit.jupiter.api.Test;

class ProgressLineTest {
    private static final int COLUMNS = 20;

    private final ByteArrayOutputStream bytes = new ByteArrayOutputStream();
    private final PrintStream stream = new PrintStream(bytes, true, StandardCharsets.UTF_8);
    private long nanos;

    private String written() {
        String text = bytes.toString(StandardCharsets.UTF_8);
        bytes.reset();
        return text;
    }

    @Test
    void line_isWrittenAFewTimesASecond_howeverOftenItIsShown() {
        var line = ProgressLine.onTerminal(stream, () -> nanos, COLUMNS);
        for (int tick = 0; tick < 1000; tick++) { // ten seconds
            line.show("run", "tick " + tick);
            nanos += Duration.ofMillis(10).toNanos();
        }
        assertThat(written().split("\r", -1)).hasSizeBetween(10, 10 * 4 + 2);
    }

    @Test
    void nextStage_isShownAtOnce() {
        var line = ProgressLine.onTerminal(stream, () -> nanos, COLUMNS);
        line.show("one", "one 1");
        line.show("one", "one 2");
        line.show("two", "two 1");
        assertThat(written()).isEqualTo("\rone 1\033[K\rtwo 1\033[K");
    }

    @Test
    void textThatDiffersInItsNumbersOnly_isNoNextStage() {
        var line = ProgressLine.onTerminal(stream, () -> nanos, COLUMNS);
        line.show("net: 10,000 markings");
        line.show("net: 20,000 markings");
        assertThat(written()).doesNotContain("20,000");
    }

    @Test
    void line_isNoWiderThanTheTerminal() {
        var line = ProgressLine.onTerminal(stream, () -> nanos, COLUMNS);
        line.show("x".repeat(3 * COLUMNS));
        assertThat(written()).isEqualTo("\r" + "x".repeat(COLUMNS - 1) + "\033[K");
    }

    @Test
    void close_wipesWhatWasShown_andWhatComesNextIsShownAtOnce() {
        var line = ProgressLine.onTerminal(stream, () -> nanos, COLUMNS);
        line.show("run", "1");
        line.interrupt(() -> stream.print("change\n"));
        line.show("run", "2");
        assertThat(written()).isEqualTo("\r1\033[K\r\033[Kchange\n\r2\033[K");
    }

    @Test
    void offATerminal_aPlainLineIsPrintedNowAndThen_withoutEscapes() {
        var line = ProgressLine.plain(stream, () -> nanos, Duration.ofSeconds(10));
        for (int second = 0; second < 25; second++) {
            line.show("run", second + " s");
            nanos += Duration.ofSeconds(1).toNanos();
        }
        line.close();
        assertThat(written().lines()).containsExactly("troupe: 10 s", "troupe: 20 s");
    }

    @Test
    void bar_isFilledUpToTheShare() {
        assertThat(ProgressLine.bar(0)).isEqualTo("[" + ".".repeat(30) + "]");
        assertThat(ProgressLine.bar(0.5)).isEqualTo("[" + "#".repeat(15) + ".".repeat(15) + "]");
        assertThat(ProgressLine.bar(1)).isEqualTo("[" + "#".repeat(30) + "]");
    }

    @Test
    void terminalThatIsDumb_getsNoEscapes() {
        assertThat(ProgressLine.knowsEscapes("dumb")).isFalse();
        assertThat(ProgressLine.knowsEscapes("xterm-256color")).isTrue();
        assertThat(ProgressLine.knowsEscapes(null)).isTrue(); // as on Windows
    }
}
