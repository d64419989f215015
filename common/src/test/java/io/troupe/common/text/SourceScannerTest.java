package io.troupe.common.text;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Path;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** The scanner of a source, and the exception for an error in it. */
class SourceScannerTest {
    private static final Path FILE = Path.of("a.world");
    private static final Pattern WORD = Pattern.compile("\\w+");
    private static final Pattern BLANKS = Pattern.compile("\\s+");
    private static final Pattern PART = Pattern.compile("(?<=])\\w+(?! )");

    @Test
    void tokens_areReadInOrder_withTheirPositions() {
        var scanner = new SourceScanner(FILE, "size  one\n\n two");
        assertThat(scanner.where()).hasToString("a.world:1:1");
        assertThat(scanner.take(BLANKS)).isEmpty();
        assertThat(scanner.peek(WORD)).isEqualTo("size");
        assertThat(scanner.take(WORD)).isEqualTo("size");
        assertThat(scanner.take(BLANKS)).isEqualTo("  ");
        assertThat(scanner.where()).isEqualTo(new SourcePosition(FILE, 1, 7));
        assertThat(scanner.take(WORD)).isEqualTo("one");
        assertThat(scanner.take(BLANKS)).isEqualTo("\n\n ");
        assertThat(scanner.where()).hasToString("a.world:3:2");
        assertThat(scanner.isAt("two")).isTrue();
        assertThat(scanner.isAt("twos")).isFalse();
        assertThat(scanner.atEnd()).isFalse();
        scanner.skip(3);
        assertThat(scanner.atEnd()).isTrue();
        assertThat(scanner.where()).hasToString("a.world:3:5");
        assertThat(scanner.offset()).isEqualTo(scanner.text().length());
        assertThat(scanner.take(WORD)).isEmpty();
    }

    @Test
    void pattern_seesWhatIsBeforeAndBehindTheToken() {
        var scanner = new SourceScanner(FILE, 7, "]part");
        assertThat(scanner.peek(PART)).isEmpty();
        scanner.skip(1);
        assertThat(scanner.peek(PART)).isEqualTo("part");
        assertThat(scanner.where()).hasToString("a.world:7:2");
    }

    @Test
    void newlineAtTheEndOfAToken_beginsTheNextLine_andAByteOrderMarkIsLeftOut() {
        var scanner = new SourceScanner(FILE, "a\n");
        scanner.skip(2);
        assertThat(scanner.where()).hasToString("a.world:2:1");
        assertThat(SourceScanner.withoutMark("\uFEFFsize")).isEqualTo("size");
        assertThat(SourceScanner.withoutMark("size")).isEqualTo("size");
    }

    @Test
    void exception_beginsWithItsPosition_exceptThatOfAWholeFile() {
        var where = new SourcePosition(Path.of("my.table"), 2, 7);
        var wrong = new SourceException(where, "no colour") {};
        assertThat(wrong).hasMessage("my.table:2:7: no colour").hasNoCause();
        assertThat(wrong.where()).contains(where);
        var cause = new IOException();
        var missing = new SourceException("my.table: no such file", cause) {};
        assertThat(missing).hasMessage("my.table: no such file").hasCause(cause);
        assertThat(missing.where()).isEmpty();
    }
}
