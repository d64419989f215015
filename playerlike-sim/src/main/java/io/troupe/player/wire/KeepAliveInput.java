package io.troupe.player.wire;

import io.troupe.actor.time.Clock;
import java.io.FilterInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.net.SocketTimeoutException;
import java.time.Duration;
import java.util.function.Supplier;

/**
 * The input of a socket, with a keep-alive check. Reads of the socket time out and are repeated. If nothing arrives for
 * half of the limit, the server is sent a request. If nothing arrives for another half, the server is reported as
 * silent, once.
 *
 * <p><b>Threads.</b> The reading thread only.
 */
final class KeepAliveInput extends FilterInputStream {
    private final Clock clock;
    private final Supplier<Duration> limit;
    private final Runnable ask;
    private final Runnable silent;
    private long sinceNanos; // time of the last byte or of the request
    private boolean asked;
    private boolean reported;

    /**
     * @param limit read at each time-out; zero for no limit
     * @param ask sends a request that every server answers
     * @param silent notified when the limit has expired
     */
    KeepAliveInput(InputStream in, Clock clock, Supplier<Duration> limit, Runnable ask, Runnable silent) {
        super(in);
        this.clock = clock;
        this.limit = limit;
        this.ask = ask;
        this.silent = silent;
        this.sinceNanos = clock.nanos();
    }

    @Override
    public int read() throws IOException {
        var one = new byte[1];
        return read(one, 0, 1) < 0 ? -1 : one[0] & 0xFF;
    }

    @Override
    public int read(byte[] bytes, int offset, int length) throws IOException {
        while (true) {
            try {
                int count = super.read(bytes, offset, length);
                sinceNanos = clock.nanos();
                asked = false;
                return count;
            } catch (SocketTimeoutException nothingCame) {
                look(limit.get());
            }
        }
    }

    private void look(Duration most) {
        long now = clock.nanos();
        if (most.isZero() || reported || now - sinceNanos < Deadline.nanos(most) / 2) {
            return;
        }
        if (asked) {
            reported = true;
            silent.run();
        } else {
            asked = true;
            sinceNanos = now;
            ask.run();
        }
    }
}
