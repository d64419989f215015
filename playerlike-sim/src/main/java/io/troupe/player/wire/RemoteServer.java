package io.troupe.player.wire;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Clock;
import java.io.IOException;
import java.io.InputStream;
import java.net.ConnectException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.SocketTimeoutException;
import java.net.UnknownHostException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import org.jspecify.annotations.Nullable;

/**
 * A Player server reached over TCP: one of ours, or a real Player 3 server.
 *
 * <p><b>Errors.</b> {@link ConnectionClosedException} if the connection cannot be established.
 *
 * <p><b>Source.</b> Player 3 protocol over TCP.
 */
public final class RemoteServer implements PlayerServer {
    private static final Duration CONNECT_LIMIT = Duration.ofSeconds(10);
    private static final int BANNER_BYTES = 32;
    private static final String BANNER_START = "Player v.";

    private final String host;
    private final int port;
    private final Duration limit;
    private final Clock clock;
    private volatile String banner = "";

    public RemoteServer(String host, int port) {
        this(host, port, CONNECT_LIMIT);
    }

    RemoteServer(String host, int port, Duration limit) {
        this(host, port, limit, Clock.system());
    }

    RemoteServer(String host, int port, Duration limit, Clock clock) {
        if (port < 1 || port > 65_535) {
            throw new IllegalArgumentException("port is " + port + ", expected 1 to 65535");
        }
        this.host = host;
        this.port = port;
        this.limit = limit;
        this.clock = clock;
    }

    /** The greeting of the server; empty before the first connection. */
    @Override
    public String banner() {
        return banner;
    }

    @Override
    public PlayerConnection connect(DataSink sink, @Nullable ActorSpace space) {
        RemoteSocket socket;
        try {
            socket = new RemoteSocket();
        } catch (IOException e) {
            throw new ConnectionClosedException(reason(e));
        }
        try {
            // InetSocketAddress alone would not report an unknown host name
            socket.connect(new InetSocketAddress(InetAddress.getByName(host), port), limit);
            banner = readBanner(socket);
            var connection = new RemoteConnection(this.toString(), socket, sink, space, limit, clock);
            connection.begin();
            return connection;
        } catch (IOException e) {
            discard(socket);
            throw new ConnectionClosedException(reason(e));
        } catch (RuntimeException | Error e) {
            discard(socket);
            throw e;
        }
    }

    private String reason(IOException e) {
        return switch (e) {
            case UnknownHostException unknown -> this + ": there is no host '" + host + "'";
            case SocketTimeoutException late -> this + " did not answer within " + limit.toMillis() + " ms";
            case ConnectException refused ->
                this + " cannot be reached: " + e.getMessage() + "; does a Player server run there?";
            default -> this + ": " + e.getMessage();
        };
    }

    /** Reads the greeting. Any other text is quoted in the error, as far as it has arrived. */
    private String readBanner(RemoteSocket socket) throws IOException {
        var deadline = Deadline.after(limit, clock);
        InputStream in = socket.input();
        var greeting = new byte[BANNER_BYTES];
        for (int length = 0; length < BANNER_BYTES; ) {
            socket.timeOutReads(Duration.ofNanos(Math.max(1, deadline.leftNanos())));
            int count = in.read(greeting, length, BANNER_BYTES - length);
            if (count < 0) {
                throw new IOException("it closed the connection instead of greeting as a Player server");
            }
            length += count;
            String start = new String(greeting, 0, length, StandardCharsets.ISO_8859_1);
            if (!start.startsWith(BANNER_START) && !BANNER_START.startsWith(start)) {
                throw new IOException("it greeted with \"" + printable(greeting, length) + "\", expected \""
                        + BANNER_START + "..\": it is no Player server");
            }
        }
        socket.timeOutReads(Duration.ZERO);
        return printable(greeting, BANNER_BYTES);
    }

    private static String printable(byte[] text, int length) {
        return new String(text, 0, length, StandardCharsets.ISO_8859_1)
                .replace("\0", "")
                .replaceAll("[^ -~]", "?");
    }

    private static void discard(RemoteSocket socket) {
        try {
            socket.close();
        } catch (IOException ignored) {
            // the socket is discarded in any case
        }
    }

    @Override
    public String toString() {
        return host + ":" + port;
    }
}
