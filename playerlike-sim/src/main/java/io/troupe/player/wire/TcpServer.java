package io.troupe.player.wire;

import com.sun.management.UnixOperatingSystemMXBean;
import io.troupe.actor.Clock;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.System.Logger;
import java.lang.System.Logger.Level;
import java.lang.management.ManagementFactory;
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
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import org.jspecify.annotations.Nullable;

/**
 * Serves the devices of one in-process port to Player clients over TCP.
 *
 * <p><b>Role.</b> One TCP port serves the devices of one robot or world. Closing the server disconnects its clients and
 * leaves the devices open.
 *
 * <p><b>Threads.</b> Any thread. The server has daemon platform threads: one accepts, one checks the limits, and each
 * client has two. No thread of the devices ever waits for a client. However many clients send without a pause, at most
 * half of the processors (at least one) handle their messages at a time; the clients take turns, one message each.
 *
 * <p><b>Order.</b> Replies are sent in the order of the requests. A pull client answers a tick by requesting data after
 * it has received that tick's frame (lock step); a push client never answers.
 *
 * <p><b>Cost.</b> Per client two threads, at most 1024 data messages (those of lasers are large) and about 130 kB of
 * replies. Messages beyond that are dropped and counted; pull clients are notified of the count. The number of clients
 * is limited by {@link Settings#maxClients}. Further clients are disconnected at once, which is logged at most once per
 * second.
 *
 * <p><b>Errors.</b> A client that sends garbage, vanishes, never sends a message, or does not read for 30 seconds only
 * loses its own connection; that is logged. The server keeps accepting after every error of accept, even if the machine
 * is short of file descriptors, threads or memory.
 *
 * <p><b>Source.</b> Player 3 protocol over TCP. It has no authentication: any client that reaches the port can drive
 * the robots.
 */
public final class TcpServer implements AutoCloseable {
    /** 127.0.0.1 in the byte order of Player's servers on x86; clients only compare it. */
    static final int LOOPBACK_HOST = 0x0100007f;

    private static final Logger LOG = System.getLogger(TcpServer.class.getName());
    private static final int BANNER_BYTES = 32;
    private static final int BACKLOG = 256;
    private static final Duration CLOSING_LIMIT = Duration.ofSeconds(5);
    private static final long QUIET_NANOS = 1_000_000_000;
    private static final long SHORTEST_PAUSE_MILLIS = 10;
    private static final long LONGEST_PAUSE_MILLIS = 1_000;

    /**
     * Limits for the clients of a server.
     *
     * @param maxClients how many clients may be connected at a time; further ones are disconnected at once
     * @param writeLimit how long a client may leave data unread
     * @param silenceLimit how long a client may be connected before its first message arrives
     */
    public record Settings(int maxClients, Duration writeLimit, Duration silenceLimit) {
        private static final int MAX_CLIENTS = 1_000;
        private static final Duration WRITE_LIMIT = Duration.ofSeconds(30);
        private static final Duration SILENCE_LIMIT = Duration.ofSeconds(60);

        public Settings {
            if (maxClients < 1) {
                throw new IllegalArgumentException("maxClients is " + maxClients + ", expected at least 1");
            }
            checkLimit("writeLimit", writeLimit);
            checkLimit("silenceLimit", silenceLimit);
        }

        private static void checkLimit(String name, Duration limit) {
            if (limit.isNegative() || limit.isZero()) {
                throw new IllegalArgumentException(name + " is " + limit + ", expected more than nothing");
            }
        }

        /**
         * Limits that fit this machine: one client for every second free file descriptor of the process (a client takes
         * one), at most 1,000; 30 seconds for a write, 60 for the first message.
         *
         * @param servers how many servers share the file descriptors
         */
        public static Settings ofMachine(int servers) {
            return new Settings(maxClients(freeDescriptors(), servers), WRITE_LIMIT, SILENCE_LIMIT);
        }

        static int maxClients(long freeDescriptors, int servers) {
            return Math.clamp(freeDescriptors / 2 / servers, 1, MAX_CLIENTS);
        }

        private static long freeDescriptors() {
            return ManagementFactory.getOperatingSystemMXBean() instanceof UnixOperatingSystemMXBean unix
                    ? unix.getMaxFileDescriptorCount() - unix.getOpenFileDescriptorCount()
                    : Long.MAX_VALUE;
        }

        /** A copy with another number of clients. */
        public Settings withMaxClients(int clients) {
            return new Settings(clients, writeLimit, silenceLimit);
        }
    }

    /**
     * State that the sessions of a server share.
     *
     * @param handling one permit per message that may be handled at a time; fair, so that a client waits at most for
     *     one message of each other client
     * @param lateCommands how many commands were dropped because they arrived late
     */
    record Shared(Settings settings, Clock clock, Semaphore handling, AtomicLong lateCommands) {
        Shared(Settings settings, Clock clock) {
            this(settings, clock, new Semaphore(Math.max(1, Runtime.getRuntime().availableProcessors() / 2), true));
        }

        Shared(Settings settings, Clock clock, Semaphore handling) {
            this(settings, clock, handling, new AtomicLong());
        }
    }

    /** Logs a frequent warning at most once per second, with the number of omitted ones. Used by one thread. */
    private static final class SparseLog {
        private final Clock clock;
        private boolean logged;
        private long loggedAtNanos;
        private int leftOut;

        SparseLog(Clock clock) {
            this.clock = clock;
        }

        void warn(String text, @Nullable Throwable thrown) {
            long now = clock.nanos();
            if (logged && now - loggedAtNanos < QUIET_NANOS) {
                leftOut++;
                return;
            }
            int before = leftOut;
            logged = true;
            loggedAtNanos = now;
            leftOut = 0;
            LOG.log(Level.WARNING, before == 0 ? text : text + " (and " + before + " times before)", thrown);
        }
    }

    private final PlayerServer devices;
    private final ServerSocket socket;
    private final Shared shared;
    private final SparseLog refusals;
    private final SparseLog failures;
    private final Set<ClientSession> sessions = ConcurrentHashMap.newKeySet();
    private final CountDownLatch closing = new CountDownLatch(1);
    private final Thread acceptor;

    private TcpServer(PlayerServer devices, ServerSocket socket, Shared shared) {
        this.devices = devices;
        this.socket = socket;
        this.shared = shared;
        this.refusals = new SparseLog(shared.clock());
        this.failures = new SparseLog(shared.clock());
        this.acceptor =
                Thread.ofPlatform().daemon().name("player-accept-" + port()).unstarted(this::accept);
    }

    /**
     * Listens on the loopback address.
     *
     * @param port 0 for any free port
     * @throws UncheckedIOException if the port cannot be opened
     */
    public static TcpServer open(PlayerServer devices, int port) {
        return open(devices, port, InetAddress.getLoopbackAddress());
    }

    /**
     * Listens on an address of this machine; logs a warning if other machines can reach it.
     *
     * @param port 0 for any free port
     * @throws UncheckedIOException if the port cannot be opened
     */
    public static TcpServer open(PlayerServer devices, int port, InetAddress bind) {
        return open(devices, port, bind, Settings.ofMachine(1));
    }

    /**
     * Listens with explicit limits.
     *
     * @param port 0 for any free port
     * @throws UncheckedIOException if the port cannot be opened
     */
    public static TcpServer open(PlayerServer devices, int port, InetAddress bind, Settings settings) {
        return open(devices, port, bind, new Shared(settings, Clock.system()));
    }

    static TcpServer open(PlayerServer devices, int port, InetAddress bind, Shared shared) {
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
                    "Player port {0} can be reached from outside, and the protocol knows no authentication: any"
                            + " program that connects drives the robots",
                    socket.getLocalSocketAddress());
        }
        return serve(devices, socket, shared);
    }

    /** Serves the clients that a socket accepts; the socket is closed with the server. */
    static TcpServer serve(PlayerServer devices, ServerSocket socket, Shared shared) {
        var server = new TcpServer(devices, socket, shared);
        server.acceptor.start();
        Thread.ofPlatform().daemon().name("player-watch-" + server.port()).start(server::watch);
        return server;
    }

    /** The port that the server listens on. */
    public int port() {
        return socket.getLocalPort();
    }

    /** Number of speeds that were dropped because they arrived later than their client allows. */
    public long lateCommands() {
        return shared.lateCommands().get();
    }

    /** Number of connected clients. */
    int clients() {
        return sessions.size();
    }

    /** The greeting as bytes: the text, padded with zeros to 32 bytes. */
    static byte[] banner(String text) {
        byte[] ascii = text.getBytes(StandardCharsets.US_ASCII);
        var banner = new byte[BANNER_BYTES];
        System.arraycopy(ascii, 0, banner, 0, Math.min(ascii.length, BANNER_BYTES - 1));
        return banner;
    }

    private void accept() {
        long pauseMillis = SHORTEST_PAUSE_MILLIS;
        while (closing.getCount() > 0) {
            try {
                admit(socket.accept());
                pauseMillis = SHORTEST_PAUSE_MILLIS;
            } catch (IOException | RuntimeException | Error e) { // an Error too: the next client may succeed
                if (closing.getCount() > 0) {
                    report(e);
                    pause(pauseMillis); // most likely too many open files
                    pauseMillis = Math.min(2 * pauseMillis, LONGEST_PAUSE_MILLIS);
                }
            }
        }
    }

    private void admit(Socket client) {
        try {
            if (sessions.size() < shared.settings().maxClients()) {
                serve(client);
            } else {
                refusals.warn(
                        "Player port " + port() + " refuses " + client.getRemoteSocketAddress() + ": "
                                + shared.settings().maxClients() + " clients are connected, which is the limit",
                        null);
                client.close();
            }
        } catch (IOException | RuntimeException | Error e) {
            discard(client);
            report(e);
        }
    }

    private void serve(Socket client) throws IOException {
        var session = new ClientSession(client, shared, sessions::remove);
        sessions.add(session);
        try {
            session.start(devices, LOOPBACK_HOST);
        } catch (IOException | RuntimeException | Error e) {
            session.close("it could not be served: " + e.getMessage());
            if (e instanceof Error) {
                throw e;
            }
        }
        if (closing.getCount() == 0) {
            session.end("the server is closed");
        }
    }

    /**
     * Logs an error of accept. Logging may need the resource that is exhausted, so its own failure is ignored and the
     * server keeps accepting.
     */
    private void report(Throwable thrown) {
        try {
            failures.warn("Player port " + port() + " could not take a client", thrown);
        } catch (RuntimeException | Error notLogged) {
            // the next failure is reported within a second
        }
    }

    private static void discard(Socket client) {
        try {
            client.close();
        } catch (IOException ignored) {
            // the socket is discarded in any case
        }
    }

    private void watch() {
        while (!pause(LONGEST_PAUSE_MILLIS)) {
            try {
                checkLimits();
            } catch (RuntimeException | Error e) {
                report(e);
            }
        }
    }

    /** Disconnects clients that do not read or never send a message. */
    void checkLimits() {
        long now = shared.clock().nanos();
        sessions.forEach(session -> session.checkLimits(now));
    }

    /** Waits; true if the server is closed. */
    private boolean pause(long millis) {
        try {
            return closing.await(millis, TimeUnit.MILLISECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return true;
        }
    }

    /** Closes all connections; the port is free when this returns. */
    @Override
    public void close() {
        closing.countDown();
        try {
            socket.close();
        } catch (IOException e) {
            LOG.log(Level.DEBUG, "Player port " + port() + " could not be closed", e);
        }
        try {
            acceptor.join(CLOSING_LIMIT); // the port is free only after the accepting thread has left the socket
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        List.copyOf(sessions).forEach(session -> session.end("the server is closed"));
    }
}
