package io.troupe.demo.serve;

import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.io.Writer;
import java.nio.file.Path;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.Test;

/** Every write error of a recording names its file. */
class NamedWriterTest {
    private static final class FullDisk extends Writer {
        @Override
        public void write(char[] text, int offset, int length) throws IOException {
            throw new IOException("no space left");
        }

        @Override
        public void flush() throws IOException {
            throw new IOException("no space left");
        }

        @Override
        public void close() throws IOException {
            throw new IOException("no space left");
        }
    }

    @Test
    @SuppressWarnings("resource") // closing it fails
    void everyFailure_namesTheFile() {
        var writer = new Serving.NamedWriter(Path.of("worlds", "run.jsonl"), new FullDisk());
        assertNamesFile(() -> writer.append("text"));
        assertNamesFile(() -> writer.write("text".toCharArray()));
        assertNamesFile(() -> writer.write('t'));
        assertNamesFile(writer::flush);
        assertNamesFile(writer::close);
    }

    private static void assertNamesFile(ThrowingCallable action) {
        assertThatThrownBy(action)
                .isInstanceOf(IOException.class)
                .hasMessage(Path.of("worlds", "run.jsonl") + ": no space left");
    }
}
