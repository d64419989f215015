package io.troupe.player.wire;

import io.troupe.actor.time.Clock;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.System.Logger;
import java.lang.System.Logger.Level;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

/**
 * Offers the devices of one in-process port to Player clients behind sockets.
 *
 * <p><b>Role.</b> One TCP port is one robot's or world's set of devices. Closing it disconnects its clients and leaves the devices open.
 * <p><b>Threads.</b> Any thread. Virtual threads of its own: one accepts, two serve each client; none of the devices' threads ever waits for a client.
 * <p><b>Order.</b> Replies come in the order of the requests. A pull client answers a tick by asking for data after it has got that tick's frame
 * (lock step); a push client never answers.
 * <p><b>Cost.</b> Per client at most 1024 messages of data and some 200 kB; what does not fit is dropped, counted, and told to pull clients.
 * <p><b>Errors.</b> A client that sends garbage, vanishes, or does not read for 30 seconds loses its own connection only; it is logged.
 * <p><b>Source.</b> Player 3 protocol over TCP. It knows no authentication: whoever reaches the port drives the robots.
 */
public final class TcpServer implements AutoCloseable {
    static final Duration WRITE_LIMIT = Duration.ofSeconds(30);

    /** 127.0.0.1 as Player's servers on x86 write it; clients compare it and do nothing else with it. */
    static final int LOOPBACK_HOST = 0x0100007f;

    private static final Logger LOG = System.getLogger(TcpServer.class.getName());
    private static final int BANNER_BYTES = 32;
    private static final int BACKLOG = 256;
    private static final Duration CLOSING_LIMIT = Duration.ofSeconds(5);

    /** By what time, and for how long, a write may be stuck. */
    record WriteClock(Clock clock, Duration limit) {
        long nanos() {
            return clock.nanos();
        }
    }

    private final PlayerServer devices;
    private final ServerSocket socket;
    private final WriteClock clock;
    private final Set<ClientSession> sessions = ConcurrentHashMap.newKeySet();
    private final CountDownLatch closing = new CountDownLatch(1);
    private final Thread acceptor;

    private TcpServer(PlayerServer devices, ServerSocket socket, WriteClock clock) {
        this.devices = devices;
        this.socket = socket;
        this.clock = clock;
        this.acceptor = Thread.ofVirtual().name("player-accept-" + port()).unstarted(this::accept);
    }

    /**
     * Listens on the loopback address.
     *
     * @param port 0 for any that is free
     * @throws UncheckedIOException if the port cannot be had
     */
    public static TcpServer open(PlayerServer devices, int port) {
        return open(devices, port, InetAddress.getLoopbackAddress());
    }

    /**
     * Listens on an address of this machine; one that others can reach is warned of.
     *
     * @param port 0 for any that is free
     * @throws UncheckedIOException if the port cannot be had
     */
    public static TcpServer open(PlayerServer devices, int port, InetAddress bind) {
        return open(devices, port, bind, new WriteClock(Clock.system(), WRITE_LIMIT));
    }

    static TcpServer open(PlayerServer devices, int port, InetAddress bind, WriteClock clock) {
        Objects.requireNonNull(devices, "devices");
        if (port < 0 || port > 65_535) {
            throw new IllegalArgumentException("port is " + port + ", expected 0 to 65535");
        }
        var address = new InetSocketAddress(bind, port);
        ServerSocket socket;
        try {
            socket = new ServerSocket(port, BACKLOG, bind);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot listen on " + address + ": " + e.getMessage(), e);
        }
        if (!bind.isLoopbackAddress()) {
            LOG.log(
                    Level.WARNING,
                    "Player port {0} can be reached from outside, and the protocol knows no authentication: whoever"
                            + " connects drives the robots",
                    socket.getLocalSocketAddress());
        }
        var server = new TcpServer(devices, socket, clock);
        server.acceptor.start();
        Thread.ofVirtual().name("player-watch-" + server.port()).start(server::watch);
        return server;
    }

    /** The port it listens on. */
    public int port() {
        return socket.getLocalPort();
    }

    /** How many clients are connected. */
    int clients() {
        return sessions.size();
    }

    /** What a server says first: text, and zeros up to 32 bytes. */
    static byte[] banner(String text) {
        byte[] ascii = text.getBytes(StandardCharsets.US_ASCII);
        var banner = new byte[BANNER_BYTES];
        System.arraycopy(ascii, 0, banner, 0, Math.min(ascii.length, BANNER_BYTES - 1));
        return banner;
    }

    private void accept() {
        while (closing.getCount() > 0) {
            try {
                serve(socket.accept());
            } catch (IOException e) {
                if (closing.getCount() > 0) {
                    LOG.log(Level.WARNING, "Player port " + port() + " could not take a client", e);
                    pause(); // too many open files, most likely
                }
            }
        }
    }

    private void serve(Socket client) {
        var session = new ClientSession(client, clock, sessions::remove);
        sessions.add(session);
        try {
            session.start(devices, LOOPBACK_HOST);
        } catch (IOException | RuntimeException e) {
            session.close("it could not be served: " + e.getMessage());
        }
        if (closing.getCount() == 0) {
            session.end("the server is closed");
        }
    }

    private void watch() {
        while (!pause()) {
            checkWrites();
        }
    }

    /** Disconnects clients that do not read. */
    void checkWrites() {
        long now = clock.nanos();
        sessions.forEach(session -> session.checkWrite(now));
    }

    /** Waits a second; true if the server is closed. */
    private boolean pause() {
        try {
            return closing.await(1, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return true;
        }
    }

    /** Ends all connections; when it returns the port is free. */
    @Override
    public void close() {
        closing.countDown();
        try {
            socket.close();
        } catch (IOException e) {
            LOG.log(Level.DEBUG, "Player port " + port() + " could not be closed", e);
        }
        try {
            acceptor.join(CLOSING_LIMIT); // the port is free only when the thread that listens has left it
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        List.copyOf(sessions).forEach(session -> session.end("the server is closed"));
    }
}
