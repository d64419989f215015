package io.troupe.player.wire;

import java.io.BufferedInputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.lang.System.Logger;
import java.lang.System.Logger.Level;
import java.net.Socket;
import java.net.SocketException;
import java.util.Objects;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;
import jdk.net.ExtendedSocketOptions;
import org.jspecify.annotations.Nullable;

/**
 * The server side of one client connected by a socket.
 *
 * <p><b>Threads.</b> Two dedicated platform threads: one reads and one writes; {@link #close} from any thread. They are
 * not virtual because virtual threads are not preempted: as many clients as there are carriers, each sending without a
 * pause, would block all other clients.
 *
 * <p><b>Errors.</b> An error ends only this session and is logged with the client's address.
 */
final class ClientSession implements DataSink {
    /** Real requests are smaller than 2,000 bytes. */
    static final int MAX_REQUEST_BYTES = 64 * 1024;

    private static final Logger LOG = System.getLogger(ClientSession.class.getName());
    private static final long IDLE = Long.MIN_VALUE;

    private final Socket socket;
    private final String peer;
    private final Outbox outbox = new Outbox();
    private final Consumer<ClientSession> ended;
    private final TcpServer.Shared shared;
    private final long connectedAtNanos;
    private final AtomicBoolean closed = new AtomicBoolean();
    private final AtomicLong writingSince = new AtomicLong(IDLE);
    private volatile boolean messageReceived;
    private volatile @Nullable PlayerConnection connection;
    private volatile @Nullable ClientMessageHandler handler;

    ClientSession(Socket socket, TcpServer.Shared shared, Consumer<ClientSession> ended) {
        this.socket = socket;
        this.peer = "Player client " + socket.getRemoteSocketAddress();
        this.shared = shared;
        this.connectedAtNanos = shared.clock().nanos();
        this.ended = ended;
    }

    /** Sends the greeting and serves the client until the session ends. */
    void start(PlayerServer devices, int host) throws IOException {
        socket.setTcpNoDelay(true);
        socket.setKeepAlive(true);
        outbox.greet(TcpServer.banner(devices.banner()));
        PlayerConnection opened = devices.connect(this, null);
        connection = opened;
        if (closed.get()) { // closed meanwhile by a server that has shut down
            opened.close();
            return;
        }
        handler = new ClientMessageHandler(peer, opened, outbox, host, socket.getLocalPort(), shared);
        LOG.log(Level.DEBUG, () -> peer + " has connected");
        thread("player-write-", this::write);
        thread("player-read-", this::read);
    }

    private void thread(String prefix, Job job) {
        Thread.ofPlatform().daemon().name(prefix + peer).start(() -> run(job));
    }

    /** The main method of a session thread; returns the reason for its end. */
    private interface Job {
        String run() throws IOException, WireException, InterruptedException;
    }

    private void run(Job job) {
        try {
            end(job.run());
        } catch (SocketException e) {
            // a push client ends like this if data are still in transit to it
            end("the client has left: " + e.getMessage());
        } catch (IOException | WireException | ConnectionClosedException | InterruptedException e) {
            close(String.valueOf(e.getMessage()));
        } catch (RuntimeException | Error e) {
            close(e.toString());
            LOG.log(Level.WARNING, peer + " led to an error of the server", e);
        } finally {
            close("its thread has ended"); // reached only if the handlers above have failed
        }
    }

    private String read() throws IOException, WireException, InterruptedException {
        var reader = new MessageReader(new BufferedInputStream(socket.getInputStream()), MAX_REQUEST_BYTES);
        ClientMessageHandler messages = Objects.requireNonNull(handler);
        while (outbox.awaitRoom()) {
            WireMessage message = reader.read();
            if (message == null) {
                return "the client has closed the connection";
            }
            messageReceived = true;
            shared.handling().acquire();
            try {
                messages.handle(message);
            } finally {
                shared.handling().release();
            }
            if (message.header().type() == MessageType.CMD) {
                acknowledgeNow();
            }
        }
        return "closed";
    }

    /**
     * Makes the kernel acknowledge received data at once. A command has no reply that could carry the acknowledgement,
     * and a client that collects small writes (Nagle, as Player's own clients do) delays its next request until the
     * acknowledgement arrives: 40 ms per tick in lock step.
     */
    private void acknowledgeNow() throws IOException {
        if (socket.supportedOptions().contains(ExtendedSocketOptions.TCP_QUICKACK)) {
            socket.setOption(ExtendedSocketOptions.TCP_QUICKACK, true); // set each time: the kernel resets this option
        }
    }

    private String write() throws IOException, InterruptedException {
        OutputStream out = socket.getOutputStream();
        while (true) {
            byte[] batch = outbox.take();
            if (batch == null) {
                return "closed";
            }
            writingSince.set(shared.clock().nanos());
            out.write(batch);
            writingSince.set(IDLE);
        }
    }

    /**
     * Closes the session if a write has been blocked for longer than the limit, or if the client has not sent a message
     * within its limit.
     */
    void checkLimits(long nowNanos) {
        TcpServer.Settings settings = shared.settings();
        long since = writingSince.get();
        if (since != IDLE && nowNanos - since > settings.writeLimit().toNanos()) {
            close("a write has not got through within " + settings.writeLimit());
        }
        if (!messageReceived
                && nowNanos - connectedAtNanos > settings.silenceLimit().toNanos()) {
            close("it has not sent a message within " + settings.silenceLimit());
        }
    }

    @Override
    public void frame(Frame frame) {
        ClientMessageHandler messages = handler;
        if (messages == null || closed.get()) {
            return;
        }
        try {
            messages.frame(frame);
        } catch (ConnectionClosedException e) {
            close(String.valueOf(e.getMessage()));
        } catch (RuntimeException | Error e) { // on the world's thread, which must survive this error
            close("its data could not be sent: " + e);
            LOG.log(Level.WARNING, peer + ": its data could not be sent", e);
        }
    }

    @Override
    public void lost(String reason) {
        end(reason);
    }

    /** Ends the session for an expected reason; logged as DEBUG. */
    void end(String reason) {
        close(Level.DEBUG, reason);
    }

    /** Ends the session for a reason worth logging as INFO. */
    void close(String reason) {
        close(Level.INFO, reason);
    }

    private void close(Level level, String reason) {
        if (!closed.compareAndSet(false, true)) {
            return;
        }
        int dropped = outbox.dropped();
        LOG.log(
                level,
                () -> peer + " is disconnected: " + reason
                        + (dropped == 0 ? "" : "; " + dropped + " data messages did not reach it"));
        outbox.close();
        try {
            socket.close(); // wakes both threads
        } catch (IOException e) {
            LOG.log(Level.DEBUG, peer + " could not be closed", e);
        }
        PlayerConnection opened = connection;
        if (opened != null) {
            opened.close();
        }
        ended.accept(this);
    }
}
