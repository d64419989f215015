package io.troupe.player.wire;

import io.troupe.actor.Clock;
import java.io.BufferedInputStream;
import java.io.FilterInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.lang.System.Logger.Level;
import java.net.SocketTimeoutException;
import java.time.Duration;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Reads the messages of a server: passes frames to the connection and replies to their callers.
 *
 * <p><b>Threads.</b> The thread that runs it; it ends with the connection.
 *
 * <p><b>Errors.</b> A message that cannot be decoded is skipped and logged. Bytes that are not a message end the
 * connection.
 */
final class RemoteReader implements Runnable {
    private static final System.Logger LOG = System.getLogger(RemoteReader.class.getName());
    /** The largest payload that Player's own clients accept. */
    private static final int MAX_PAYLOAD_BYTES = 32 * 1024 * 1024;

    private static final int NEXT_DATA =
            PlayerDeviceCodec.encode(new PlayerRequest.NextData()).subtype();

    private final RemoteConnection connection;
    private final String name;
    private final RemoteSocket socket;
    private final PendingReplies pending;
    private final FrameAssembler frames;

    RemoteReader(
            RemoteConnection connection,
            String name,
            RemoteSocket socket,
            PendingReplies pending,
            FrameAssembler frames) {
        this.connection = connection;
        this.name = name;
        this.socket = socket;
        this.pending = pending;
        this.frames = frames;
    }

    @Override
    public void run() {
        try {
            var input = new KeepAliveInput(
                    socket.input(),
                    Clock.system(),
                    connection::silenceLimit,
                    connection::sendKeepAlive,
                    connection::serverSilent);
            var messages = new MessageReader(new BufferedInputStream(input), MAX_PAYLOAD_BYTES);
            for (WireMessage message = messages.read(); message != null; message = messages.read()) {
                take(message);
            }
            connection.lose(connection.gone("it closed the connection"));
        } catch (IOException e) {
            connection.lose(connection.gone(e.getMessage()));
        } catch (WireException e) {
            connection.lose(name + " sent what is not the Player protocol: " + e.getMessage());
        } catch (RuntimeException | Error e) {
            connection.lose(name + ": a message could not be handled: " + e);
            LOG.log(Level.ERROR, name + ": a message could not be handled", e);
        }
    }

    private void take(WireMessage message) {
        switch (message.header().type()) {
            case DATA -> data(message);
            case SYNCH -> synch(message);
            case ACK, NACK -> reply(message);
            case CMD, REQ -> LOG.log(Level.WARNING, "{0} sent {1}, which only clients do", name, message);
        }
    }

    private void data(WireMessage message) {
        var header = message.header();
        try {
            var content = DataCodec.decode(header.address().interfaceCode(), header.subtype(), message.payload());
            if (content.isPresent()) {
                var from = connection.listed(header.address());
                frames.add(new DeviceDataMessage(from, header.timeSeconds(), content.get()))
                        .forEach(connection::deliver);
            }
        } catch (WireException e) {
            LOG.log(Level.WARNING, "{0}: {1} is left out: {2}", name, message, e.getMessage());
        }
    }

    private void synch(WireMessage message) {
        try {
            int dropped = PlayerDeviceCodec.dropped(message.header().subtype(), message.payload());
            if (dropped != 0) {
                LOG.log(Level.WARNING, "{0} has dropped {1} messages: this client is too slow", name, dropped);
            }
        } catch (WireException e) {
            LOG.log(Level.WARNING, "{0}: {1}: {2}", name, message, e.getMessage());
        }
        frames.synch().forEach(connection::deliver);
    }

    private void reply(WireMessage message) {
        var header = message.header();
        if (header.address().interfaceCode() == PlayerRequest.INTERFACE && header.subtype() == NEXT_DATA) {
            if (header.type() == MessageType.NACK) {
                LOG.log(Level.WARNING, "{0} refused to send data in pull mode", name);
                frames.refused();
            } else {
                frames.granted().forEach(connection::deliver);
            }
            return; // the data follow
        }
        frames.reply().forEach(connection::deliver);
        if (!pending.answer(message)) {
            LOG.log(Level.DEBUG, "{0}: {1} answers nothing that is waited for", name, message);
        }
    }

    /**
     * The input of a socket, with a keep-alive check. Reads of the socket time out and are repeated. If nothing arrives
     * for half of the limit, the server is sent a request. If nothing arrives for another half, the server is reported
     * as silent, once.
     *
     * <p><b>Threads.</b> The reading thread only.
     */
    static final class KeepAliveInput extends FilterInputStream {
        private final Clock clock;
        private final Supplier<@Nullable Duration> limit;
        private final Runnable ask;
        private final Consumer<Duration> silent;
        private long sinceNanos; // time of the last byte or of the request
        private boolean asked;
        private boolean reported;

        /**
         * @param limit read at each time-out; zero for no limit
         * @param ask sends a request that every server answers
         * @param silent notified when the limit has expired
         */
        KeepAliveInput(
                InputStream in,
                Clock clock,
                Supplier<@Nullable Duration> limit,
                Runnable ask,
                Consumer<Duration> silent) {
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
                    checkLimit(limit.get());
                }
            }
        }

        private void checkLimit(@Nullable Duration silenceLimit) {
            long now = clock.nanos();
            if (silenceLimit == null || reported || now - sinceNanos < Deadline.nanos(silenceLimit) / 2) {
                return;
            }
            if (asked) {
                reported = true;
                silent.accept(silenceLimit);
            } else {
                asked = true;
                sinceNanos = now;
                ask.run();
            }
        }
    }
}
