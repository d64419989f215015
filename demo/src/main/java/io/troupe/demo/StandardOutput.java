package io.troupe.demo;

import java.io.FilterOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import org.jspecify.annotations.Nullable;

/**
 * Remembers why it could not be written: the streams above it swallow that, and a command would end as if all were
 * well.
 */
final class StandardOutput extends FilterOutputStream {
    /** A reader that has seen enough, as {@code head}, is no error. */
    private static final String READER_GONE = "Broken pipe";

    private volatile @Nullable String lost;

    StandardOutput(OutputStream to) {
        super(to);
    }

    @Override
    public void write(int single) throws IOException {
        write(new byte[] {(byte) single}, 0, 1);
    }

    @Override
    public void write(byte[] bytes, int offset, int length) throws IOException {
        try {
            out.write(bytes, offset, length);
        } catch (IOException e) {
            lost = e.getMessage();
            throw e;
        }
    }

    /** Why something was not written; null if all was, or no reader is left. */
    @Nullable
    String lost() {
        return READER_GONE.equals(lost) ? null : lost;
    }
}
