package io.troupe.bus.nats;

import io.nats.client.AuthenticationException;
import io.nats.client.Connection;
import io.nats.client.ConnectionListener;
import io.nats.client.Consumer;
import io.nats.client.Dispatcher;
import io.nats.client.ErrorListener;
import io.nats.client.Message;
import io.nats.client.MessageHandler;
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
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.ThreadFactory;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.regex.Pattern;
import javax.net.ssl.SSLException;
import org.jspecify.annotations.Nullable;

/**
 * The engine of a bus on NATS.
 *
 * <p>Only features of NATS 2.2 are used: publish and subscribe, headers, and the status "no responders" (503), which
 * reports at once that a node does not exist. JetStream is not used: it would deliver again, and a velocity that is
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
    private static final int MOST_QUEUED_OUT = 10_000;
    private static final int USUAL_MOST_QUEUED_IN = 100_000;
    private static final long MOST_BYTES_IN = 64L << 20;
    private static final int OLDEST_MAJOR = 2;
    private static final int OLDEST_MINOR = 2;

    /** The words of the server, before the subject in quotation marks; NATS 2.2 and later. */
    private static final Pattern VIOLATION =
            Pattern.compile("(?i)permissions violation for (publish|subscription)[^\"]*\"([^\"]*)\"");

    private final NatsSettings settings;
    private final int mostQueuedIn;
    private final Subjects subjects;
    private final AtomicBoolean isConnected = new AtomicBoolean();
    private final AtomicBoolean isClosed = new AtomicBoolean();
    private final Threads threads;
    private volatile boolean isEstablished;
    private boolean hasName; // used by the thread of the inbox only
    private volatile @Nullable String why = "it has not been started";
    private final CompletableFuture<Connection> connecting = new CompletableFuture<>();
    private final CompletableFuture<Exception> firstProblem = new CompletableFuture<>();
    private @Nullable Connection connection;
    private volatile List<Inflow> inflows = List.of();
    private @Nullable Inflow publications;
    private String node = "";
    private long incarnation;
    private String replies = "";
    private String gone = "";
    private int maxFrameBytes;

    /**
     * Daemon threads, so that a program that ends need not close its bus. All are of these pools, because those that
     * the client makes itself stay when a connection breaks while it is closed.
     */
    private static final class Threads {
        private final AtomicInteger number = new AtomicInteger();
        private volatile String node = "";
        final ThreadFactory factory = this::thread;
        final ExecutorService workers = Executors.newCachedThreadPool(factory);
        final ExecutorService callbacks = Executors.newSingleThreadExecutor(factory);
        final ScheduledExecutorService timers = Executors.newSingleThreadScheduledExecutor(factory);

        private Thread thread(Runnable work) {
            var thread = new Thread(work, "nats " + node + " " + number.incrementAndGet());
            thread.setDaemon(true);
            return thread;
        }

        void close() {
            workers.shutdown();
            callbacks.shutdown();
            timers.shutdownNow();
        }
    }

    NatsEngine(NatsSettings settings) {
        this(settings, USUAL_MOST_QUEUED_IN);
    }

    /** @param mostQueuedIn the most frames that wait for each of the two threads that deliver */
    NatsEngine(NatsSettings settings, int mostQueuedIn) {
        this.settings = settings;
        this.mostQueuedIn = mostQueuedIn;
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
        try {
            begin(opened, listener);
        } catch (BusException refused) {
            throw refused;
        } catch (RuntimeException | Error failure) { // the client throws many when the connection breaks meanwhile
            throw cannotConnect("the connection broke while the node was opened: " + failure.getMessage(), failure);
        }
    }

    private void begin(Connection opened, Listener listener) {
        checkVersion(opened);
        maxFrameBytes = (int) Math.min(Integer.MAX_VALUE, opened.getMaxPayload());
        var claim = new CompletableFuture<@Nullable Void>();
        var inbox = new Inflow(opened, listener);
        inbox.subscribe(subjects.who(node), message -> answerWho(opened, message, claim));
        inbox.subscribe(subjects.node(node), message -> {
            if (hasName) { // else they are for the process that has it
                listener.frame(message.getData());
            }
        });
        inbox.subscribe(replies + "*", message -> receiveReply(message, listener, claim));
        inbox.subscribe(gone + ">", message -> receiveGone(message, listener));
        publications = new Inflow(opened, listener);
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
                .dataPortType(NamedServerPort.class.getName())
                .socketSoLinger(0) // what a broken connection has not sent yet is discarded
                .pingInterval(PING_INTERVAL)
                .maxPingsOut(MOST_PINGS_OUT)
                .connectionTimeout(settings.connectLimit())
                .maxMessagesInOutgoingQueue(MOST_QUEUED_OUT)
                .discardMessagesWhenOutgoingQueueFull() // senders do not wait
                .executor(threads.workers)
                .scheduledExecutor(threads.timers)
                .connectExecutor(threads.workers)
                .callbackExecutor(threads.callbacks)
                .readerExecutor(threads.workers)
                .writerExecutor(threads.workers)
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
            return await(options.build());
        } catch (NoSuchAlgorithmException none) {
            throw cannotConnect("this Java has no TLS: " + none.getMessage(), none);
        }
    }

    /** Connects on another thread, because the client waits for the whole limit after the server has refused it. */
    private Connection await(Options options) {
        Future<?> attempt = threads.workers.submit(() -> {
            try {
                Connection opened = Nats.connect(options);
                if (!connecting.complete(opened)) {
                    opened.close();
                }
            } catch (IOException | InterruptedException | RuntimeException | Error failure) {
                connecting.completeExceptionally(failure);
            }
        });
        try {
            return connecting.get();
        } catch (ExecutionException failure) {
            attempt.cancel(true);
            throw switch (failure.getCause()) {
                case AuthenticationException refused -> cannotConnect(refusal(), refused);
                case IOException other -> cannotConnect(reason(other), other);
                case null, default -> cannotConnect(String.valueOf(failure.getCause()), failure);
            };
        } catch (InterruptedException interrupted) {
            attempt.cancel(true);
            Thread.currentThread().interrupt();
            throw cannotConnect("the thread was interrupted", interrupted);
        }
    }

    private String refusal() {
        return settings.user() == null
                ? "the server asks for a user and a password (a token or a key cannot be given)"
                : "the server does not accept the user \"" + settings.user() + "\" with that password";
    }

    private String reason(IOException failure) {
        Throwable cause =
                firstProblem.completeOnTimeout(failure, 1, TimeUnit.SECONDS).join(); // the client reports it later
        for (Throwable each = cause; each != null; each = each.getCause()) {
            if (each instanceof UnknownHostException || each instanceof UnresolvedAddressException) {
                return "the host is not known: check the name in the address";
            }
            if (each instanceof ConnectException) {
                return "nothing accepts connections there: is nats-server running, and does it listen on that address?";
            }
            if (each instanceof SSLException) {
                return "no encrypted connection: " + each.getMessage()
                        + (isAboutOurCertificate(each)
                                ? "; the server asks for a certificate of this process: give one by NatsSettings.withTls"
                                : "");
            }
        }
        String text = cause.getMessage() == null ? cause.getClass().getSimpleName() : cause.getMessage();
        if (text.contains("SSL required")) {
            return "the server asks for TLS: use an address that begins with tls://";
        }
        if (text.contains("SSL connection wanted")) {
            return "the server has no TLS: use an address that begins with nats://";
        }
        if (isRefusal(text)) {
            return refusal();
        }
        return text;
    }

    /** The alerts by which servers refuse a client without a certificate. */
    private static boolean isAboutOurCertificate(Throwable failure) {
        String text = String.valueOf(failure.getMessage());
        return text.contains("fatal alert") && text.matches(".*(bad_certificate|certificate_required).*");
    }

    private static boolean isRefusal(String error) {
        return error.contains("uthorization") || error.contains("uthentication");
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
            flush(opened);
            checkPermissions(opened);
            claim.get(settings.connectLimit().toMillis(), TimeUnit.MILLISECONDS);
        } catch (ExecutionException taken) {
            close();
            throw (BusException) taken.getCause();
        } catch (TimeoutException silent) {
            if (opened.getStatus() != Connection.Status.CONNECTED) {
                throw cannotConnect("the connection broke before the name was claimed", silent);
            }
            close();
            throw taken("and does not answer; it may hang, or be cut off");
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            throw cannotConnect("the thread was interrupted", interrupted);
        }
    }

    private void flush(Connection opened) throws InterruptedException {
        try {
            opened.flush(settings.connectLimit());
        } catch (TimeoutException silent) {
            throw cannotConnect("the server has accepted the connection, but does not answer", silent);
        }
    }

    /** The server refuses a subscription by a message that comes before the end of a flush. */
    private void checkPermissions(Connection opened) {
        String error = opened.getLastError();
        if (error != null && VIOLATION.matcher(error).find()) {
            close();
            throw new BusException("node " + node + " cannot be opened on " + String.join(", ", settings.servers())
                    + ": " + missingPermission(error));
        }
    }

    private String missingPermission(String error) {
        return "the server does not permit it to node " + node + ": " + error.strip()
                + "; the user needs publish and subscribe permission for \"" + settings.application() + ".>\"";
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

    /** Decides the claim by what another process reports of itself. */
    private void decide(byte[] who, CompletableFuture<@Nullable Void> claim) {
        if (who.length < Long.BYTES + 1) {
            return;
        }
        var other = ByteBuffer.wrap(who);
        long itsIncarnation = other.getLong();
        if (other.get() != 0 || itsIncarnation < incarnation) {
            claim.completeExceptionally(taken("(its incarnation is " + itsIncarnation + ")"));
        } else {
            succeed(claim);
        }
    }

    /** On the thread that answers the claims of others, so that none of them finds the name free from now on. */
    private void succeed(CompletableFuture<@Nullable Void> claim) {
        if (claim.complete(null)) {
            hasName = true;
        }
    }

    // ---- receiving

    /** A thread of the client that delivers, with a queue. If the queue is full, the client drops the newest frames. */
    private final class Inflow {
        private final Dispatcher dispatcher;
        private final Listener listener;
        private long reported; // guarded by this

        Inflow(Connection opened, Listener listener) {
            this.listener = listener;
            dispatcher = opened.createDispatcher(message -> handle(message, it -> listener.frame(it.getData())));
            dispatcher.setPendingLimits(mostQueuedIn, MOST_BYTES_IN);
            var all = new ArrayList<>(inflows);
            all.add(this);
            inflows = List.copyOf(all);
        }

        void subscribe(String subject, MessageHandler handler) {
            dispatcher.subscribe(subject, message -> handle(message, handler));
        }

        /** The client would only pass on what a handler throws. */
        private void handle(Message message, MessageHandler handler) {
            try {
                handler.onMessage(message);
            } catch (Exception | Error failure) {
                listener.lost(
                        1, "node " + node + " could not handle a frame of " + size(message) + " bytes: " + failure);
                if (failure instanceof InterruptedException) {
                    Thread.currentThread().interrupt();
                }
            }
            reportAtLast();
        }

        private static int size(Message message) {
            return message.getData() == null ? 0 : message.getData().length;
        }

        /** To frames that are passed to the listener. */
        void subscribe(String subject) {
            dispatcher.subscribe(subject);
        }

        /** The client reports only the first of several frames that it drops. */
        private void reportAtLast() {
            if (dispatcher.getPendingMessageCount() == 0) {
                report();
            }
        }

        void unsubscribe(String subject) {
            dispatcher.unsubscribe(subject);
        }

        boolean is(Consumer consumer) {
            return dispatcher == consumer;
        }

        void report() {
            long dropped;
            synchronized (this) {
                dropped = dispatcher.getDroppedCount() - reported;
                reported += dropped;
            }
            if (dropped > 0) {
                listener.lost(
                        dropped,
                        "node " + node + " receives more than it can handle: " + mostQueuedIn + " frames wait");
            }
        }
    }

    private void receiveReply(Message message, Listener listener, CompletableFuture<@Nullable Void> claim) {
        String number = message.getSubject().substring(replies.length());
        if (number.equals("who")) {
            if (message.isStatusMessage()) {
                succeed(claim); // no other process has the name
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
                    if (isConnected.get()) {
                        open.flush(Duration.ofSeconds(1)); // the last marks
                    }
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
                case RESUBSCRIBED -> connected(source);
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

        private void connected(Connection source) {
            if (isEstablished && !isClosed.get() && hasSubscribed(source) && isConnected.compareAndSet(false, true)) {
                why = null;
                listener.connected();
            }
        }

        /** The subscriptions were sent; waits until the server has them. */
        private boolean hasSubscribed(Connection source) {
            try {
                source.flush(settings.connectLimit());
                return true;
            } catch (TimeoutException | IllegalStateException disconnected) {
                return false; // another event will report that it is connected
            } catch (InterruptedException interrupted) {
                Thread.currentThread().interrupt();
                return false;
            }
        }
    }

    private final class Problems implements ErrorListener {
        private final Listener listener;
        private volatile @Nullable String lastProblem; // an equal one is not reported again

        Problems(Listener listener) {
            this.listener = listener;
        }

        @Override
        public void errorOccurred(Connection source, String error) {
            if (!isEstablished) {
                firstProblem.complete(new IOException(error));
                if (isRefusal(error) && settings.servers().size() == 1) {
                    connecting.completeExceptionally(new AuthenticationException(error));
                }
                return;
            }
            var violation = VIOLATION.matcher(error);
            if (!violation.find()) {
                listener.lost(0, "the server reports: " + error.strip());
            } else if (violation.group(2).startsWith(subjects.nodes())) {
                String to = violation.group(2).substring(subjects.nodes().length());
                listener.rejected(Subjects.text(to), missingPermission(error));
            } else {
                boolean isOneMessage = violation.group(1).equalsIgnoreCase("publish");
                listener.lost(isOneMessage ? 1 : 0, missingPermission(error));
            }
        }

        @Override
        public void exceptionOccurred(Connection source, Exception problem) {
            boolean isFirst = firstProblem.complete(problem);
            if (!isEstablished
                    && problem instanceof SSLException
                    && settings.servers().size() == 1) {
                connecting.completeExceptionally(problem);
            }
            if (isFirst || !isEstablished || isClosed.get()) {
                return;
            }
            // while it is disconnected, it is tried again several times a second
            String text = isConnected.get() ? String.valueOf(problem) : refusedBy(problem);
            if (text != null && !text.equals(lastProblem)) {
                lastProblem = text;
                listener.lost(0, "the connection reports: " + text);
            }
        }

        /** Why a server to which this node connects again is not trusted; null for anything else. */
        private @Nullable String refusedBy(Throwable problem) {
            for (Throwable each = problem; each != null; each = each.getCause()) {
                if (each instanceof SSLException) {
                    return "no encrypted connection: " + each.getMessage();
                }
            }
            return null;
        }

        @Override
        public void slowConsumerDetected(Connection source, Consumer slow) {
            inflows.stream().filter(each -> each.is(slow)).forEach(Inflow::report);
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
