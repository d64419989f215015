package io.troupe.view.live;

import java.io.BufferedInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.lang.System.Logger.Level;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;

/**
 * A port for pages and WebSockets. It reads the head of the first request of each connection: one that asks for a
 * WebSocket is served here, any other one is connected with an HTTP server behind it.
 *
 * <p>The HTTP server of the JDK accepts its connections itself and has no upgrade, so it cannot share a port in another
 * way (ADR 20).
 *
 * <p>A client cannot keep others out: a connection without a head gives way to a new one, and ends after a limit; of
 * one address there are at most {@link #MOST_OF_ONE_ADDRESS}.
 *
 * <p><b>Threads.</b> A virtual thread for each direction of a connection. A reader that is slow holds up its own
 * connection only.
 */
final class SharedPort implements AutoCloseable {
    private static final System.Logger LOG = System.getLogger(SharedPort.class.getName());
    private static final int MOST_HEAD_BYTES = 16_384;
    static final int MOST_CONNECTIONS = 512;
    static final int MOST_OF_ONE_ADDRESS = 128;
    /** For the whole head of the first request, from its first byte. */
    private static final Duration HEAD_LIMIT = Duration.ofSeconds(10);
    /** Until the first byte: browsers open connections before they need them. */
    private static final int UNUSED_MILLIS = 60_000;
    /** Small, so that a page that reads slowly is not seconds behind. */
    private static final int BUFFER_BYTES = 1 << 16;

    /** A request up to its empty line; names of headers are in lower case. */
    record Head(String method, String target, Map<String, String> headers, byte[] bytes) {
        boolean isUpgrade() {
            return headers.getOrDefault("upgrade", "").equalsIgnoreCase("websocket");
        }

        /** Reads a head; the bytes alone count if it is none. */
        static Head read(InputStream in) throws IOException {
            var bytes = new ByteArrayOutputStream();
            for (int next = in.read(); next >= 0; next = in.read()) {
                bytes.write(next);
                if (next == '\n' && endsWithEmptyLine(bytes) || bytes.size() >= MOST_HEAD_BYTES) {
                    break;
                }
            }
            String[] lines = bytes.toString(StandardCharsets.ISO_8859_1).split("\r?\n");
            String[] request = lines.length == 0 ? lines : lines[0].split(" ");
            Map<String, String> headers = new HashMap<>();
            for (int i = 1; i < lines.length; i++) {
                String[] header = lines[i].split(":", 2);
                if (header.length == 2) {
                    headers.putIfAbsent(header[0].strip().toLowerCase(Locale.ROOT), header[1].strip());
                }
            }
            return new Head(
                    request.length > 0 ? request[0] : "",
                    request.length > 1 ? request[1] : "",
                    headers,
                    bytes.toByteArray());
        }

        private static boolean endsWithEmptyLine(ByteArrayOutputStream bytes) {
            String text = bytes.toString(StandardCharsets.ISO_8859_1);
            return text.endsWith("\r\n\r\n") || text.endsWith("\n\n");
        }
    }

    /** Serves a connection that asks for a WebSocket, until its end. */
    interface Upgrade {
        void serve(Head head, InputStream in, OutputStream out) throws IOException, InterruptedException;
    }

    /** A connection, which waits until its first request has a head. */
    private static final class Connection {
        final Socket socket;
        final InetAddress from;
        private boolean waits = true; // guarded by this

        Connection(Socket socket) {
            this.socket = socket;
            from = socket.getInetAddress();
        }

        synchronized void hasHead() {
            waits = false;
        }

        /** Closes it if it waits still. */
        synchronized boolean giveUp() {
            if (waits) {
                end();
            }
            return waits;
        }

        void end() {
            try {
                socket.close();
            } catch (IOException e) {
                LOG.log(Level.DEBUG, "a connection of the live page could not be closed", e);
            }
        }
    }

    private final ServerSocket server;
    private final InetSocketAddress behind;
    private final Duration headLimit;
    private final Set<Connection> connections = new LinkedHashSet<>(); // oldest first; guarded by itself
    private final ScheduledThreadPoolExecutor limits = new ScheduledThreadPoolExecutor(
            1, Thread.ofPlatform().name("live page limits").daemon().factory());
    private boolean toldOfRefusals; // used by the thread that accepts only

    private SharedPort(ServerSocket server, InetSocketAddress behind, Duration headLimit) {
        this.server = server;
        this.behind = behind;
        this.headLimit = headLimit;
        limits.setRemoveOnCancelPolicy(true);
    }

    /**
     * Takes the port.
     *
     * @param behind the HTTP server, on this machine
     */
    static SharedPort bind(InetAddress address, int port, InetSocketAddress behind) throws IOException {
        return bind(address, port, behind, HEAD_LIMIT);
    }

    /** @param headLimit how long the head of the first request may take, from its first to its last byte */
    static SharedPort bind(InetAddress address, int port, InetSocketAddress behind, Duration headLimit)
            throws IOException {
        var server = new ServerSocket();
        try {
            server.setReceiveBufferSize(BUFFER_BYTES);
            server.bind(new InetSocketAddress(address, port), MOST_CONNECTIONS);
        } catch (IOException e) {
            server.close();
            throw e;
        }
        return new SharedPort(server, behind, headLimit);
    }

    /** Begins to serve connections. */
    void start(Upgrade upgrade) {
        Thread.ofPlatform().name("live page port").daemon().start(() -> acceptAll(upgrade));
    }

    int port() {
        return server.getLocalPort();
    }

    private void acceptAll(Upgrade upgrade) {
        while (!server.isClosed()) {
            try {
                var connection = new Connection(server.accept());
                if (!admit(connection)) {
                    refuse(connection);
                } else {
                    Thread.ofVirtual().name("live page connection").start(() -> serve(connection, upgrade));
                }
            } catch (IOException e) {
                if (!server.isClosed()) {
                    LOG.log(Level.WARNING, "the port of the live page could not accept a connection", e);
                }
            }
        }
    }

    /**
     * Makes room for a connection: at a limit, the oldest one ends that has not sent the head of a request yet; one of
     * the same address, if these are too many. False if all connections are in use.
     */
    private boolean admit(Connection connection) {
        synchronized (connections) {
            boolean isFull = connections.size() >= MOST_CONNECTIONS;
            boolean isMany =
                    connections.stream().filter(each -> isOf(connection, each)).count() >= MOST_OF_ONE_ADDRESS;
            if (isFull || isMany) {
                var ended = connections.stream()
                        .filter(each -> !isMany || isOf(connection, each))
                        .filter(Connection::giveUp)
                        .findFirst();
                if (ended.isEmpty()) {
                    return false;
                }
                connections.remove(ended.get());
            }
            connections.add(connection);
            return true;
        }
    }

    private static boolean isOf(Connection one, Connection other) {
        return one.from.equals(other.from);
    }

    private void refuse(Connection connection) {
        connection.end();
        if (!toldOfRefusals) {
            toldOfRefusals = true;
            LOG.log(
                    Level.WARNING,
                    () -> "the live page refuses connections of " + connection.from.getHostAddress() + ": it has "
                            + MOST_OF_ONE_ADDRESS + " of that address or " + MOST_CONNECTIONS + " of all");
        }
    }

    private void serve(Connection connection, Upgrade upgrade) {
        var socket = connection.socket;
        try (socket) {
            socket.setTcpNoDelay(true);
            socket.setSendBufferSize(BUFFER_BYTES);
            var in = new BufferedInputStream(socket.getInputStream());
            Head head = readHead(connection, in);
            if (head.bytes.length == 0) {
                return;
            }
            if (head.isUpgrade()) {
                upgrade.serve(head, in, socket.getOutputStream());
            } else {
                connect(socket, in, head);
            }
        } catch (IOException gone) {
            LOG.log(Level.DEBUG, "a connection of the live page ended", gone);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } finally {
            synchronized (connections) {
                connections.remove(connection);
            }
        }
    }

    /** A limit of the socket would begin anew with each byte. */
    private Head readHead(Connection connection, InputStream in) throws IOException {
        connection.socket.setSoTimeout(UNUSED_MILLIS);
        in.mark(1);
        in.read();
        in.reset();
        connection.socket.setSoTimeout(0);
        var limit = limits.schedule(connection::giveUp, headLimit.toNanos(), TimeUnit.NANOSECONDS);
        try {
            return Head.read(in);
        } finally {
            connection.hasHead();
            limit.cancel(false);
        }
    }

    private void connect(Socket socket, InputStream in, Head head) throws IOException, InterruptedException {
        try (var http = new Socket()) {
            http.setReceiveBufferSize(BUFFER_BYTES);
            http.setTcpNoDelay(true);
            http.connect(behind);
            http.getOutputStream().write(head.bytes);
            Thread back = Thread.ofVirtual().start(() -> copy(http, socket));
            try {
                in.transferTo(http.getOutputStream());
                http.shutdownOutput();
            } catch (IOException gone) {
                http.shutdownInput(); // the viewer is gone: its stream ends, and http is closed
            }
            back.join();
        }
    }

    /** Copies the answers; at their end the connection ends. */
    private static void copy(Socket http, Socket socket) {
        try (socket) {
            http.getInputStream().transferTo(socket.getOutputStream());
        } catch (IOException gone) {
            LOG.log(Level.DEBUG, "a connection of the live page ended", gone);
        } finally {
            try {
                http.close();
            } catch (IOException e) {
                LOG.log(Level.DEBUG, "a connection of the live page could not be closed", e);
            }
        }
    }

    /** Ends all connections. */
    @Override
    public void close() throws IOException {
        server.close();
        limits.shutdownNow();
        synchronized (connections) {
            connections.forEach(Connection::end);
        }
    }
}
