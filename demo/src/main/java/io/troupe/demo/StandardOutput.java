package io.troupe.demo;

import java.io.FilterOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import org.jspecify.annotations.Nullable;

/**
 * Standard output that records the last write error. The print streams above it swallow exceptions, so that a command
 * would report success.
 */
final class StandardOutput extends FilterOutputStream {
    /** A reader that stops early, such as {@code head}, is no error. */
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

    /** The error of the last failed write; null if there was none, or if only the reader has closed the pipe. */
    @Nullable
    String lost() {
        return READER_GONE.equals(lost) ? null : lost;
    }
}
