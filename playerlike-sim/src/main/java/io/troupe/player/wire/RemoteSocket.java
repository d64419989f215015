package io.troupe.player.wire;

import io.troupe.actor.Clock;
import java.io.IOException;
import java.io.InputStream;
import java.io.InterruptedIOException;
import java.net.InetSocketAddress;
import java.net.SocketTimeoutException;
import java.net.StandardSocketOptions;
import java.nio.ByteBuffer;
import java.nio.channels.ClosedChannelException;
import java.nio.channels.ClosedSelectorException;
import java.nio.channels.SelectionKey;
import java.nio.channels.Selector;
import java.nio.channels.SocketChannel;
import java.nio.channels.spi.SelectorProvider;
import java.time.Duration;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.ReentrantLock;
import org.jspecify.annotations.Nullable;

/**
 * A client's socket on which no operation blocks for ever: neither connecting, nor sending to a server that does not
 * read.
 *
 * <p><b>Threads.</b> One thread reads; any thread sends and closes.
 *
 * <p><b>Errors.</b> A send that does not complete throws {@link SocketTimeoutException} after its limit, or
 * {@link InterruptedIOException} when its thread is interrupted. The socket stays usable. The exception's
 * {@code bytesTransferred} is the number of bytes of the message that were sent: 0 if the server will never see the
 * message; otherwise the rest is sent before the next message.
 */
final class RemoteSocket implements AutoCloseable {
    private static final Clock CLOCK = Clock.system();

    private final SocketChannel channel;
    private final Selector readable;
    private final ReentrantLock sending = new ReentrantLock();
    private volatile @Nullable ByteBuffer unsent; // rest of a partly sent message; written under sending
    private volatile long readTimeoutNanos; // 0 = none

    RemoteSocket() throws IOException {
        this(SelectorProvider.provider());
    }

    RemoteSocket(SelectorProvider provider) throws IOException {
        channel = provider.openSocketChannel();
        try {
            readable = provider.openSelector();
        } catch (IOException | RuntimeException | Error e) {
            channel.close();
            throw e;
        }
    }

    void connect(InetSocketAddress server, Duration limit) throws IOException {
        channel.socket().connect(server, Math.toIntExact(limit.toMillis()));
        channel.setOption(StandardSocketOptions.TCP_NODELAY, true);
        channel.setOption(StandardSocketOptions.SO_KEEPALIVE, true);
        channel.configureBlocking(false);
        channel.register(readable, SelectionKey.OP_READ);
    }

    /**
     * Sets the time-out of reads, also of a read that is already waiting: it throws {@link SocketTimeoutException} if
     * nothing arrives for that long. Reading may be continued after that. Zero for no time-out.
     */
    void timeOutReads(Duration timeout) {
        readTimeoutNanos = timeout.toNanos();
        readable.wakeup();
    }

    InputStream input() {
        return new InputStream() {
            @Override
            public int read() throws IOException {
                var octet = new byte[1];
                return read(octet, 0, 1) < 0 ? -1 : octet[0] & 0xFF;
            }

            @Override
            public int read(byte[] bytes, int offset, int length) throws IOException {
                return length == 0 ? 0 : receive(ByteBuffer.wrap(bytes, offset, length));
            }
        };
    }

    private int receive(ByteBuffer into) throws IOException {
        long beganNanos = CLOCK.nanos();
        try {
            for (int count = channel.read(into); ; count = channel.read(into)) {
                if (count != 0) {
                    return count;
                }
                long timeoutNanos = readTimeoutNanos;
                await(readable, timeoutNanos > 0, beganNanos + timeoutNanos - CLOCK.nanos());
            }
        } catch (ClosedSelectorException closed) {
            throw new ClosedChannelException();
        }
    }

    /** Sends a message, after the unsent rest of the previous one. */
    void send(byte[] message, Deadline deadline) throws IOException {
        try {
            if (!sending.tryLock() && !sending.tryLock(deadline.leftNanos(), TimeUnit.NANOSECONDS)) {
                throw new SocketTimeoutException("another thread is still sending");
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new InterruptedIOException("interrupted");
        }
        try {
            ByteBuffer rest = unsent;
            if (rest != null) {
                write(rest, deadline);
                unsent = null;
            }
            var bytes = ByteBuffer.wrap(message);
            try {
                write(bytes, deadline);
            } catch (InterruptedIOException e) {
                e.bytesTransferred = bytes.position();
                throw e;
            } finally {
                if (bytes.hasRemaining() && bytes.position() > 0) {
                    unsent = bytes;
                }
            }
        } finally {
            sending.unlock();
        }
    }

    /** Sends the rest of a partly sent message, if there is one. */
    void sendRest(Deadline deadline) throws IOException {
        if (unsent != null) {
            send(new byte[0], deadline);
        }
    }

    private void write(ByteBuffer bytes, Deadline deadline) throws IOException {
        channel.write(bytes);
        if (!bytes.hasRemaining()) {
            return; // the usual case
        }
        try (var writable = Selector.open()) {
            channel.register(writable, SelectionKey.OP_WRITE);
            while (bytes.hasRemaining()) {
                await(writable, true, deadline.leftNanos());
                channel.write(bytes);
            }
        }
    }

    private static void await(Selector ready, boolean hasDeadline, long leftNanos) throws IOException {
        if (hasDeadline && leftNanos <= 0) {
            throw new SocketTimeoutException("the limit is over");
        }
        ready.select(hasDeadline ? leftNanos / 1_000_000 + 1 : 0);
        ready.selectedKeys().clear();
        if (Thread.currentThread().isInterrupted()) {
            throw new InterruptedIOException("interrupted");
        }
    }

    /** Ends blocked reads and sends. */
    @Override
    public void close() throws IOException {
        try (channel) {
            readable.close();
        }
    }
}
