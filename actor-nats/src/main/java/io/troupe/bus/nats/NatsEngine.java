package io.troupe.bus.nats;

import io.nats.client.AuthenticationException;
import io.nats.client.Connection;
import io.nats.client.ConnectionListener;
import io.nats.client.Consumer;
import io.nats.client.Dispatcher;
import io.nats.client.ErrorListener;
import io.nats.client.Message;
import io.nats.client.Nats;
import io.nats.client.Options;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusException;
import java.io.IOException;
import java.net.ConnectException;
import java.net.UnknownHostException;
import java.nio.ByteBuffer;
import java.nio.channels.UnresolvedAddressException;
import java.security.NoSuchAlgorithmException;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.ThreadFactory;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicLong;
import javax.net.ssl.SSLException;
import org.jspecify.annotations.Nullable;

/**
 * The engine of a bus on NATS.
 *
 * <p>Only features of NATS 2.2 are used: publish and subscribe, headers, and the status "no responders" (503), which
 * says at once that a node does not exist. JetStream is not used: it would deliver again, and a velocity that is
 * delivered again is a danger.
 *
 * <p><b>Threads.</b> The client's threads are daemons with the name of the node. Two of them deliver: one the frames to
 * this node, one the publications, so that a flood of readings does not hold up a request.
 */
final class NatsEngine implements BusEngine {
    /** A cut is noticed after {@link #MOST_PINGS_OUT} + 1 intervals. */
    private static final Duration PING_INTERVAL = Duration.ofMillis(500);

    private static final int MOST_PINGS_OUT = 2;
    private static final Duration RECONNECT_WAIT = Duration.ofMillis(200);
    private static final Duration WHO_LIMIT = Duration.ofSeconds(1);
    private static final int MOST_QUEUED_OUT = 10_000;
    private static final int MOST_QUEUED_IN = 100_000;
    private static final long MOST_BYTES_IN = 64L << 20;
    private static final int OLDEST_MAJOR = 2;
    private static final int OLDEST_MINOR = 2;

    private final NatsSettings settings;
    private final Subjects subjects;
    private final AtomicBoolean isConnected = new AtomicBoolean();
    private final AtomicBoolean isClosed = new AtomicBoolean();
    private final AtomicLong droppedBefore = new AtomicLong();
    private final Threads threads;
    private volatile boolean isEstablished;
    private volatile @Nullable String why = "it has not been started";
    private final CompletableFuture<Exception> firstProblem = new CompletableFuture<>();
    private @Nullable Connection connection;
    private @Nullable Dispatcher publications;
    private String node = "";
    private long incarnation;
    private String replies = "";
    private String gone = "";
    private int maxFrameBytes;

    /** Daemon threads, so that a program that ends need not close its bus. */
    private static final class Threads {
        private final AtomicInteger number = new AtomicInteger();
        private volatile String node = "";
        final ThreadFactory factory = this::thread;
        final ExecutorService workers = Executors.newCachedThreadPool(factory);
        final ScheduledExecutorService timers = Executors.newSingleThreadScheduledExecutor(factory);

        private Thread thread(Runnable work) {
            var thread = new Thread(work, "nats " + node + " " + number.incrementAndGet());
            thread.setDaemon(true);
            return thread;
        }

        void close() {
            workers.shutdown();
            timers.shutdownNow();
        }
    }

    NatsEngine(NatsSettings settings) {
        this.settings = settings;
        this.subjects = new Subjects(settings.application());
        this.threads = new Threads();
    }

    @Override
    public void start(String itsNode, long itsIncarnation, Listener listener) {
        node = itsNode;
        incarnation = itsIncarnation;
        threads.node = itsNode;
        replies = subjects.replies(node, incarnation);
        gone = subjects.gone(node, incarnation);
        Connection opened = connect(listener);
        connection = opened;
        checkVersion(opened);
        maxFrameBytes = (int) Math.min(Integer.MAX_VALUE, opened.getMaxPayload());
        var claim = new CompletableFuture<@Nullable Void>();
        Dispatcher inbox = dispatcher(opened, listener);
        inbox.subscribe(subjects.who(node), message -> answerWho(opened, message, claim));
        inbox.subscribe(subjects.node(node), message -> listener.frame(message.getData()));
        inbox.subscribe(replies + "*", message -> receiveReply(message, listener, claim));
        inbox.subscribe(gone + ">", message -> receiveGone(message, listener));
        publications = dispatcher(opened, listener);
        claimName(opened, claim);
        isEstablished = true;
        why = null;
        isConnected.set(true);
    }

    // ---- connecting

    private Connection connect(Listener listener) {
        var options = new Options.Builder()
                .servers(settings.servers().toArray(String[]::new))
                .connectionName("troupe " + node)
                .noEcho() // the bus delivers at home itself
                .maxReconnects(-1)
                .reconnectWait(RECONNECT_WAIT)
                .reconnectBufferSize(0) // nothing is kept for later
                .socketSoLinger(0) // what a broken connection has not sent yet is discarded
                .pingInterval(PING_INTERVAL)
                .maxPingsOut(MOST_PINGS_OUT)
                .connectionTimeout(settings.connectLimit())
                .maxMessagesInOutgoingQueue(MOST_QUEUED_OUT)
                .discardMessagesWhenOutgoingQueueFull() // senders do not wait
                .executor(threads.workers)
                .scheduledExecutor(threads.timers)
                .connectThreadFactory(threads.factory)
                .callbackThreadFactory(threads.factory)
                .readerThreadFactory(threads.factory)
                .writerThreadFactory(threads.factory)
                .connectionListener(new Events(listener))
                .errorListener(new Problems(listener));
        if (settings.user() != null) {
            options.userInfo(settings.user(), Objects.requireNonNull(settings.password()));
        }
        try {
            if (settings.tls() != null) {
                options.sslContext(settings.tls());
            } else if (settings.servers().stream().anyMatch(server -> server.startsWith("tls:"))) {
                options.secure();
            }
            return Nats.connect(options.build());
        } catch (AuthenticationException refused) {
            throw cannotConnect(refusal(), refused);
        } catch (IOException failure) {
            throw cannotConnect(reason(failure), failure);
        } catch (NoSuchAlgorithmException none) {
            throw cannotConnect("this Java has no TLS: " + none.getMessage(), none);
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            throw cannotConnect("the thread was interrupted", interrupted);
        }
    }

    private String refusal() {
        return settings.user() == null
                ? "the server asks for a user and a password"
                : "the server does not accept the user \"" + settings.user() + "\" with that password";
    }

    private String reason(IOException failure) {
        Throwable cause =
                firstProblem.completeOnTimeout(failure, 1, TimeUnit.SECONDS).join(); // the client reports it later
        String text = String.valueOf(cause.getMessage());
        for (Throwable each = cause; each != null; each = each.getCause()) {
            if (each instanceof UnknownHostException || each instanceof UnresolvedAddressException) {
                return "the host is not known: check the name in the address";
            }
            if (each instanceof ConnectException) {
                return "nothing accepts connections there: is nats-server running, and does it listen on that address?";
            }
            if (each instanceof SSLException) {
                return "no encrypted connection: " + each.getMessage();
            }
        }
        if (text.contains("SSL required")) {
            return "the server asks for TLS: use an address that begins with tls://";
        }
        if (text.contains("SSL connection wanted")) {
            return "the server has no TLS: use an address that begins with nats://";
        }
        if (text.contains("uthorization") || text.contains("uthentication")) {
            return refusal();
        }
        return text;
    }

    private BusException cannotConnect(String reason, Throwable cause) {
        close();
        return new BusException(
                "node " + node + " cannot connect to " + String.join(", ", settings.servers()) + ": " + reason, cause);
    }

    private void checkVersion(Connection opened) {
        String version = String.valueOf(opened.getServerInfo().getVersion());
        String[] parts = version.split("[.-]");
        try {
            int major = Integer.parseInt(parts[0]);
            int minor = parts.length < 2 ? 0 : Integer.parseInt(parts[1]);
            if (major > OLDEST_MAJOR || major == OLDEST_MAJOR && minor >= OLDEST_MINOR) {
                return;
            }
        } catch (NumberFormatException unknown) {
            return; // a development version
        }
        close();
        throw new BusException("node " + node + " cannot use the server at " + String.join(", ", settings.servers())
                + ": it is nats-server " + version + ", expected " + OLDEST_MAJOR + "." + OLDEST_MINOR + " or later");
    }

    // ---- the name of the node

    /**
     * Asks whether another process has the name. Of two processes that ask at the same time, the one with the smaller
     * incarnation gets the name.
     */
    private void claimName(Connection opened, CompletableFuture<@Nullable Void> claim) {
        try {
            opened.publish(subjects.who(node), replies + "who", who(false));
            claim.get(WHO_LIMIT.toMillis(), TimeUnit.MILLISECONDS);
        } catch (ExecutionException taken) {
            close();
            throw (BusException) taken.getCause();
        } catch (TimeoutException silent) {
            close();
            throw taken("and does not answer; it may hang, or be cut off");
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            throw cannotConnect("the thread was interrupted", interrupted);
        }
    }

    private BusException taken(String details) {
        return new BusException("node " + node + " cannot be opened: another process has that name on "
                + String.join(", ", settings.servers()) + " (application " + settings.application() + ") " + details);
    }

    private byte[] who(boolean established) {
        return ByteBuffer.allocate(Long.BYTES + 1)
                .putLong(incarnation)
                .put((byte) (established ? 1 : 0))
                .array();
    }

    private void answerWho(Connection opened, Message question, CompletableFuture<@Nullable Void> claim) {
        // a claim that has just succeeded counts, although the opening thread has not noticed it yet
        boolean hasName = isEstablished || claim.isDone() && !claim.isCompletedExceptionally();
        if (question.getReplyTo() != null) {
            opened.publish(question.getReplyTo(), who(hasName));
        }
        if (!hasName) {
            decide(question.getData(), claim);
        }
    }

    /** Decides the claim by what another process says of itself. */
    private void decide(byte[] who, CompletableFuture<@Nullable Void> claim) {
        if (who.length < Long.BYTES + 1) {
            return;
        }
        var other = ByteBuffer.wrap(who);
        long itsIncarnation = other.getLong();
        if (other.get() != 0 || itsIncarnation < incarnation) {
            claim.completeExceptionally(taken("(its incarnation is " + itsIncarnation + ")"));
        } else {
            claim.complete(null);
        }
    }

    // ---- receiving

    private Dispatcher dispatcher(Connection opened, Listener listener) {
        Dispatcher dispatcher = opened.createDispatcher(message -> listener.frame(message.getData()));
        dispatcher.setPendingLimits(MOST_QUEUED_IN, MOST_BYTES_IN);
        return dispatcher;
    }

    private void receiveReply(Message message, Listener listener, CompletableFuture<@Nullable Void> claim) {
        String number = message.getSubject().substring(replies.length());
        if (number.equals("who")) {
            if (message.isStatusMessage()) {
                claim.complete(null); // no other process has the name
            } else {
                decide(message.getData(), claim);
            }
        } else if (message.isStatusMessage()) {
            int dot = number.indexOf('-');
            listener.unreachable(
                    Subjects.text(number.substring(dot + 1)),
                    Long.parseLong(number.substring(0, Math.max(0, dot))),
                    "no node of that name is connected now");
        } else {
            listener.frame(message.getData());
        }
    }

    private void receiveGone(Message message, Listener listener) {
        if (message.isStatusMessage()) {
            String[] parts = message.getSubject().substring(gone.length()).split("\\.");
            listener.gone(Subjects.text(parts[0]), Long.parseLong(parts[1]));
        }
    }

    // ---- sending

    @Override
    public @Nullable String whyDisconnected() {
        return why;
    }

    @Override
    public int maxFrameBytes() {
        return maxFrameBytes;
    }

    @Override
    public void send(String to, long number, byte[] frame) {
        connected().publish(subjects.node(to), replies + number + "-" + Subjects.token(to), frame);
    }

    @Override
    public void reply(String to, long toIncarnation, long number, byte[] frame) {
        connected()
                .publish(
                        subjects.replies(to, toIncarnation) + number,
                        gone + Subjects.token(to) + "." + toIncarnation,
                        frame);
    }

    @Override
    public void publish(String topic, byte[] frame) {
        connected().publish(subjects.topic(topic), frame);
    }

    @Override
    public void subscribe(String topic) {
        Objects.requireNonNull(publications).subscribe(subjects.topic(topic));
    }

    @Override
    public void unsubscribe(String topic) {
        if (!isClosed.get()) {
            Objects.requireNonNull(publications).unsubscribe(subjects.topic(topic));
        }
    }

    private Connection connected() {
        return Objects.requireNonNull(connection, "the engine has not been started");
    }

    @Override
    public void close() {
        if (isClosed.compareAndSet(false, true)) {
            why = "it is closed";
            Connection open = connection;
            if (open != null) {
                try {
                    open.flush(Duration.ofSeconds(1)); // the last marks
                } catch (TimeoutException | IllegalStateException disconnected) {
                    why = "it is closed, and was disconnected before";
                } catch (InterruptedException interrupted) {
                    Thread.currentThread().interrupt();
                }
                try {
                    open.close();
                } catch (InterruptedException interrupted) {
                    Thread.currentThread().interrupt();
                }
            }
            threads.close();
        }
    }

    // ---- events of the client

    /** Several events of one disconnection are one. */
    private final class Events implements ConnectionListener {
        private final Listener listener;

        Events(Listener listener) {
            this.listener = listener;
        }

        @Override
        @SuppressWarnings("deprecation") // abstract, so it must be there; the client calls the other one
        public void connectionEvent(Connection source, ConnectionListener.Events event) {}

        @Override
        public void connectionEvent(Connection source, ConnectionListener.Events event, Long time, String details) {
            switch (event) {
                case DISCONNECTED, CLOSED -> disconnected();
                case RESUBSCRIBED -> connected();
                default -> {} // the others are steps between these
            }
        }

        private void disconnected() {
            if (isConnected.compareAndSet(true, false) && !isClosed.get()) {
                String reason = "it is disconnected from " + String.join(", ", settings.servers());
                why = reason;
                listener.disconnected(reason);
            }
        }

        private void connected() {
            if (isEstablished && !isClosed.get() && isConnected.compareAndSet(false, true)) {
                why = null;
                listener.connected();
            }
        }
    }

    private final class Problems implements ErrorListener {
        private final Listener listener;

        Problems(Listener listener) {
            this.listener = listener;
        }

        @Override
        public void errorOccurred(Connection source, String error) {
            if (error.contains("ermissions Violation")) {
                listener.lost(
                        1,
                        "the server does not permit it to node " + node + ": " + error.strip()
                                + "; the user needs publish and subscribe permission for \"" + settings.application()
                                + ".>\"");
            } else if (isEstablished) {
                listener.lost(0, "the server reports: " + error.strip());
            } else {
                firstProblem.complete(new IOException(error));
            }
        }

        @Override
        public void exceptionOccurred(Connection source, Exception problem) {
            firstProblem.complete(problem);
        }

        @Override
        public void slowConsumerDetected(Connection source, Consumer slow) {
            long dropped = slow.getDroppedCount();
            long before = droppedBefore.getAndSet(dropped);
            listener.lost(
                    Math.max(1, dropped - before),
                    "node " + node + " receives more than it can handle: " + MOST_QUEUED_IN + " frames wait");
        }

        @Override
        public void messageDiscarded(Connection source, Message discarded) {
            String replyTo = discarded.getReplyTo();
            String reason = "more than " + MOST_QUEUED_OUT + " messages wait to be sent";
            if (replyTo != null && replyTo.startsWith(replies)) {
                String number = replyTo.substring(replies.length());
                int dash = number.indexOf('-');
                listener.unreachable(
                        Subjects.text(number.substring(dash + 1)), Long.parseLong(number.substring(0, dash)), reason);
            } else {
                listener.lost(1, reason);
            }
        }
    }
}
