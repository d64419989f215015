package io.troupe.common.text;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;

class SourceExceptionTest {
    private static final class Wrong extends SourceException {
        private static final long serialVersionUID = 1L;

        Wrong(SourcePosition where, String problem) {
            super(where, problem);
        }

        Wrong(String problem, IOException cause) {
            super(problem, cause);
        }
    }

    @Test
    void message_beginsWithThePosition() {
        var where = new SourcePosition(Path.of("my.table"), 2, 7);
        var wrong = new Wrong(where, "no colour");
        assertThat(wrong).hasMessage("my.table:2:7: no colour").hasNoCause();
        assertThat(wrong.where()).contains(where);
    }

    @Test
    void exceptionOfAWholeFile_hasNoPosition() {
        var cause = new IOException();
        var wrong = new Wrong("my.table: no such file", cause);
        assertThat(wrong).hasMessage("my.table: no such file").hasCause(cause);
        assertThat(wrong.where()).isEmpty();
    }
}
