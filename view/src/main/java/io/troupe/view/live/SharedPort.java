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
import java.util.HashMap;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

/**
 * A port for pages and WebSockets. It reads the head of the first request of each connection: one that asks for a
 * WebSocket is served here, any other one is connected with an HTTP server behind it.
 *
 * <p>The HTTP server of the JDK accepts its connections itself and has no upgrade, so it cannot share a port in another
 * way (ADR 20).
 *
 * <p><b>Threads.</b> A virtual thread for each direction of a connection. A reader that is slow holds up its own
 * connection only.
 */
final class SharedPort implements AutoCloseable {
    private static final System.Logger LOG = System.getLogger(SharedPort.class.getName());
    private static final int MOST_HEAD_BYTES = 16_384;
    private static final int MOST_CONNECTIONS = 512;
    /** Browsers open connections before they need them. */
    private static final int HEAD_MILLIS = 60_000;
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
            String[] request = lines[0].split(" ");
            Map<String, String> headers = new HashMap<>();
            for (int i = 1; i < lines.length; i++) {
                String[] header = lines[i].split(":", 2);
                if (header.length == 2) {
                    headers.putIfAbsent(header[0].strip().toLowerCase(Locale.ROOT), header[1].strip());
                }
            }
            return new Head(request[0], request.length > 1 ? request[1] : "", headers, bytes.toByteArray());
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

    private final ServerSocket server;
    private final InetSocketAddress behind;
    private final Set<Socket> sockets = ConcurrentHashMap.newKeySet();

    private SharedPort(ServerSocket server, InetSocketAddress behind) {
        this.server = server;
        this.behind = behind;
    }

    /**
     * Takes the port.
     *
     * @param behind the HTTP server, on this machine
     */
    static SharedPort bind(InetAddress address, int port, InetSocketAddress behind) throws IOException {
        var server = new ServerSocket();
        try {
            server.setReceiveBufferSize(BUFFER_BYTES);
            server.bind(new InetSocketAddress(address, port));
        } catch (IOException e) {
            server.close();
            throw e;
        }
        return new SharedPort(server, behind);
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
                Socket socket = server.accept();
                if (sockets.size() >= MOST_CONNECTIONS) {
                    socket.close();
                } else {
                    sockets.add(socket);
                    Thread.ofVirtual().name("live page connection").start(() -> serve(socket, upgrade));
                }
            } catch (IOException e) {
                if (!server.isClosed()) {
                    LOG.log(Level.WARNING, "the port of the live page could not accept a connection", e);
                }
            }
        }
    }

    private void serve(Socket socket, Upgrade upgrade) {
        try (socket) {
            socket.setTcpNoDelay(true);
            socket.setSendBufferSize(BUFFER_BYTES);
            socket.setSoTimeout(HEAD_MILLIS);
            var in = new BufferedInputStream(socket.getInputStream());
            Head head = Head.read(in);
            socket.setSoTimeout(0);
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
            sockets.remove(socket);
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
        for (Socket socket : sockets) {
            socket.close();
        }
    }
}
