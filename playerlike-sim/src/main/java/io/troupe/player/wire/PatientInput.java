package io.troupe.player.wire;

import io.troupe.actor.time.Clock;
import java.io.FilterInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.net.SocketTimeoutException;
import java.time.Duration;
import java.util.function.Supplier;

/**
 * The input of a socket whose reads time out again and again, which is no reason to stop reading: when nothing has come
 * for half of a limit the server is asked for a sign of life, and when nothing comes for another half it is reported as
 * silent, once.
 *
 * <p><b>Threads.</b> The one that reads.
 */
final class PatientInput extends FilterInputStream {
    private final Clock clock;
    private final Supplier<Duration> limit;
    private final Runnable ask;
    private final Runnable silent;
    private long sinceNanos; // the last byte, or the question
    private boolean asked;
    private boolean reported;

    /** @param limit asked at each time-out; zero for none */
    PatientInput(InputStream in, Clock clock, Supplier<Duration> limit, Runnable ask, Runnable silent) {
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
