package io.troupe.player;

import java.io.IOException;
import java.io.OutputStream;

/** Where a device in the original writes its messages; here whoever tries is told what to do instead. */
final class ClosedOutput extends OutputStream {
    @Override
    public void write(int octet) throws IOException {
        throw new IOException("bytes cannot be written to a device: use the methods of its class");
    }
}
