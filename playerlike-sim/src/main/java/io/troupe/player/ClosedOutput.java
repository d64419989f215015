package io.troupe.player;

import java.io.IOException;
import java.io.OutputStream;

/**
 * The output stream of a device. In the original client a device writes its messages here; this one rejects every write
 * with an error that names the alternative.
 */
final class ClosedOutput extends OutputStream {
    @Override
    public void write(int octet) throws IOException {
        throw new IOException("bytes cannot be written to a device: use the methods of its class");
    }
}
