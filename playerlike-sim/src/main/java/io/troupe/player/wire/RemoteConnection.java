package io.troupe.player.wire;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Clock;
import java.io.IOException;
import java.io.InterruptedIOException;
import java.lang.System.Logger.Level;
import java.net.SocketTimeoutException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * A client's connection to a server over a socket.
 *
 * <p><b>Threads.</b> Any thread. A daemon thread reads and passes frames to the sink and replies to their callers; it
 * ends when the connection is closed. Every call but {@link #close} returns within the client's limit, which covers
 * sending and waiting for the reply together, even if the server does not read. It also returns when its thread is
 * interrupted; the connection stays usable. No call here waits for data. On an actor space, the next data are requested
 * when the space has no more work. No call of the program sees that request, so if it fails, the connection counts as
 * lost.
 *
 * <p><b>Order.</b> Messages of one thread are sent in order. Data that arrive before a reply reach the sink before the
 * caller gets the reply.
 */
final class RemoteConnection implements PlayerConnection {
    private static final System.Logger LOG = System.getLogger(RemoteConnection.class.getName());
    /** Longest time between two checks for a silent server during a read; only used with a silence limit. */
    private static final int READ_TIMEOUT_MILLIS = 500;
    /** Bound of frames queued for a busy space, the same as a server's queue for a client. */
    private static final int MAX_QUEUED_FRAMES = 1024;

    private static final DeviceAddress PLAYER = new DeviceAddress(0, 0, PlayerRequest.INTERFACE, 0);

    private final String name;
    private final RemoteSocket socket;
    private final DataSink sink;
    private final @Nullable ActorSpace space;
    private final Thread reader;
    private final Clock clock;
    private final long firstStampNanos; // a second before the connection, because a stamp of 0 means none
    private final PendingReplies pending;
    private final FrameAssembler frames = new FrameAssembler();
    private final Map<DeviceAddress, String> drivers = new ConcurrentHashMap<>();
    private final Queue<Frame> forSpace = new ArrayDeque<>(); // guarded by its own monitor
    private boolean overflowLogged; // used by the reader only
    private volatile List<DeviceAddress> devices = List.of();
    private volatile Duration replyLimit;
    private volatile @Nullable Duration silenceLimit; // null: no limit
    private final AtomicReference<@Nullable End> end = new AtomicReference<>();

    /** @param lost true if the server is gone; false if the client closed this connection */
    private record End(String reason, boolean lost) {}

    RemoteConnection(
            String name,
            RemoteSocket socket,
            DataSink sink,
            @Nullable ActorSpace space,
            Duration replyLimit,
            Clock clock) {
        this.name = name;
        this.socket = socket;
        this.sink = sink;
        this.space = space;
        this.replyLimit = replyLimit;
        this.clock = clock;
        this.firstStampNanos = clock.nanos() - 1_000_000_000;
        this.pending = new PendingReplies(clock);
        this.reader = Thread.ofPlatform()
                .daemon()
                .name("player-connection-" + name)
                .unstarted(() -> new RemoteReader(this, name, socket, pending, frames).run());
    }

    /** Starts the reader and requests the list of devices. */
    void begin() {
        reader.start();
        try {
            if (ask(new PlayerRequest.DeviceList(), "the device list") instanceof PlayerReply.DeviceList list) {
                devices = list.devices();
            } else {
                throw new RequestFailedException(name + " refused the request for its list of devices");
            }
        } catch (RuntimeException e) {
            close();
            throw e;
        }
    }

    // ---- called by the client

    @Override
    public List<DeviceAddress> devices() {
        checkOpen();
        return devices;
    }

    @Override
    public String driverName(DeviceAddress device) {
        checkOpen();
        String known = drivers.get(device);
        if (known != null) {
            return known;
        }
        if (ask(new PlayerRequest.DriverInfo(device), "the driver of " + text(device))
                instanceof PlayerReply.DriverInfo info) {
            drivers.put(device, info.driver());
            return info.driver();
        }
        throw new IllegalArgumentException(name + " has no device " + text(device));
    }

    @Override
    public void subscribe(DeviceAddress device) {
        access(device, PlayerRequest.OPEN, "subscribing to ");
    }

    @Override
    public void unsubscribe(DeviceAddress device) {
        access(device, PlayerRequest.CLOSE, "unsubscribing from ");
    }

    private void access(DeviceAddress device, int mode, String doing) {
        String what = doing + text(device);
        switch (ask(new PlayerRequest.Access(device, mode), what)) {
            case PlayerReply.Access granted when granted.mode() == mode -> drivers.put(device, granted.driver());
            case PlayerReply.Access other ->
                throw new RequestFailedException("Error " + what + ": " + name + " granted access " + other.mode()
                        + ", expected " + mode + "; its driver has failed");
            case PlayerReply.Nack nack ->
                throw new RequestFailedException("Negative acknowledgement received for " + what + " at " + name);
            default -> throw new RequestFailedException(what + ": " + name + " answered something else");
        }
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        Content content = CommandCodec.encode(command);
        send(device, MessageType.CMD, content, 0, deadline(), () -> {});
    }

    @Override
    public DeviceReply request(DeviceAddress device, DeviceRequest request) {
        Content content = RequestCodec.encode(device.interfaceCode(), request);
        return decode(call(device, content, request + " to " + text(device)));
    }

    @Override
    public void request(DeviceAddress device, DeviceRequest request, Consumer<DeviceReply> receiver) {
        checkOpen();
        Content content = RequestCodec.encode(device.interfaceCode(), request);
        var deadline = deadline();
        var sent = pending.add(device, content.subtype());
        sent.reply().orTimeout(deadline.leftNanos(), TimeUnit.NANOSECONDS).whenComplete((message, failure) -> {
            if (message != null) {
                receiver.accept(decode(message));
            } else {
                pending.giveUp(sent);
                receiver.accept(new DeviceReply.Nack(
                        failure instanceof TimeoutException
                                ? "no reply within " + deadline.millis()
                                : String.valueOf(failure.getMessage())));
            }
        });
        try {
            send(device, content, sent, deadline);
        } catch (ConnectionClosedException | RequestFailedException notSent) {
            sent.reply().completeExceptionally(notSent);
        }
    }

    @Override
    public void replyLimit(Duration limit) {
        replyLimit = limit;
    }

    @Override
    public void silenceLimit(@Nullable Duration limit) {
        checkOpen();
        long halfMillis = limit == null ? 0 : Deadline.nanos(limit) / 2 / 1_000_000; // 0: reads wait without limit
        socket.timeOutReads(Duration.ofMillis(Math.min(halfMillis, READ_TIMEOUT_MILLIS)));
        silenceLimit = limit;
    }

    @Override
    public void answered(long tick) {
        checkOpen();
        var deadline = deadline();
        if (frames.wantsData(tick)) {
            Content request = PlayerDeviceCodec.encode(new PlayerRequest.NextData());
            send(PLAYER, MessageType.REQ, request, 0, deadline, frames::refused);
        } else if (frames.mode() == Delivery.PULL) {
            // the request may have been sent in part, and no other message may follow
            sending(() -> socket.sendRest(deadline), deadline, () -> {});
        }
    }

    @Override
    public void answers(boolean whether) {
        // the server knows the delivery mode
    }

    @Override
    public void delivery(Delivery mode) {
        checkOpen();
        Content content = PlayerDeviceCodec.encode(new PlayerRequest.DataMode(mode));
        var deadline = deadline();
        var sent = pending.add(PLAYER, content.subtype());
        // on the reader thread, so that the mode changes at its place in the stream
        var changed = sent.reply().thenApply(message -> {
            if (message.header().type() == MessageType.ACK) {
                frames.mode(mode).forEach(this::deliver);
            }
            return message;
        });
        send(PLAYER, content, sent, deadline);
        if (await(changed, sent, deadline, "the mode of delivery " + mode)
                        .header()
                        .type()
                == MessageType.NACK) {
            throw new RequestFailedException(name + " refused the mode of delivery " + mode);
        }
    }

    @Override
    public void replace(ReplaceRule rule) {
        if (ask(new PlayerRequest.AddRule(rule), rule.toString()) instanceof PlayerReply.Nack) {
            throw new RequestFailedException(name + " refused " + rule);
        }
    }

    @Override
    public void close() {
        end(new End("the connection to " + name + " is closed", false));
        if (Thread.currentThread() != reader) {
            try {
                reader.join();
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
    }

    // ---- sending, and waiting for replies

    private PlayerReply ask(PlayerRequest request, String what) {
        WireMessage message = call(PLAYER, PlayerDeviceCodec.encode(request), what);
        try {
            return PlayerDeviceCodec.reply(
                    message.header().type(), message.header().subtype(), message.payload());
        } catch (WireException e) {
            throw new RequestFailedException(what + ": " + name + " answered what cannot be read: " + e.getMessage());
        }
    }

    private WireMessage call(DeviceAddress device, Content content, String what) {
        checkOpen();
        var deadline = deadline();
        var sent = pending.add(device, content.subtype());
        send(device, content, sent, deadline);
        return await(sent.reply(), sent, deadline, what);
    }

    private Deadline deadline() {
        return Deadline.after(replyLimit, clock);
    }

    /**
     * Sends a request. If that fails in the middle of the message, the request counts as given up: the rest is sent
     * later and gets a reply.
     */
    private void send(DeviceAddress device, Content content, PendingReplies.Request request, Deadline deadline) {
        try {
            send(device, MessageType.REQ, content, request.sequence(), deadline, () -> pending.drop(request));
        } catch (RuntimeException e) {
            pending.giveUp(request); // no effect if it was dropped
            throw e;
        }
    }

    private WireMessage await(
            CompletableFuture<WireMessage> awaited, PendingReplies.Request sent, Deadline deadline, String what) {
        try {
            return awaited.get(deadline.leftNanos(), TimeUnit.NANOSECONDS);
        } catch (TimeoutException e) {
            pending.giveUp(sent);
            throw new RequestFailedException(
                    name + " did not answer within " + deadline.millis() + ": " + what + " was requested");
        } catch (InterruptedException e) {
            pending.giveUp(sent);
            Thread.currentThread().interrupt();
            throw new RequestFailedException("interrupted while waiting for " + name + ": " + what + " was requested");
        } catch (ExecutionException e) {
            checkOpen();
            throw new ConnectionClosedException(e.getCause().getMessage());
        }
    }

    private DeviceReply decode(WireMessage message) {
        var header = message.header();
        try {
            return ReplyCodec.decode(
                    header.address().interfaceCode(), header.type(), header.subtype(), message.payload());
        } catch (WireException e) {
            return new DeviceReply.Nack("the reply cannot be read: " + e.getMessage());
        }
    }

    /**
     * @param nothingSent called if sending fails before the first byte, so the server will never receive the message
     */
    private void send(
            DeviceAddress device,
            MessageType type,
            Content content,
            int sequence,
            Deadline deadline,
            Runnable nothingSent) {
        byte[] payload = content.payload();
        double stampSeconds = (clock.nanos() - firstStampNanos) / 1e9;
        var header = new Header(device, type, content.subtype(), stampSeconds, sequence, payload.length);
        checkOpen();
        sending(() -> socket.send(new WireMessage(header, payload).bytes(), deadline), deadline, nothingSent);
    }

    private interface Sending {
        void run() throws IOException;
    }

    private void sending(Sending sending, Deadline deadline, Runnable nothingSent) {
        try {
            sending.run();
        } catch (InterruptedIOException e) {
            if (e.bytesTransferred == 0) {
                nothingSent.run();
            }
            if (e instanceof SocketTimeoutException) {
                throw new RequestFailedException(
                        name + " has not taken a message within " + deadline.millis() + ": " + e.getMessage());
            }
            throw new RequestFailedException("interrupted while sending to " + name);
        } catch (IOException e) {
            lose(gone(e.getMessage()));
            checkOpen();
        }
    }

    /** The address from the device list: real servers differ in the host and robot parts that they send. */
    DeviceAddress listed(DeviceAddress device) {
        return devices.stream()
                .filter(each -> each.interfaceCode() == device.interfaceCode() && each.index() == device.index())
                .findFirst()
                .orElse(device);
    }

    /**
     * Throws if the connection is closed. A call that fails because the server is gone first notifies the sink, since
     * the thread that noticed the loss may not have done so yet. So after one call has reported the loss, every later
     * call fails too, on the connection and on the sink.
     */
    private void checkOpen() {
        End ended = end.get();
        if (ended != null) {
            if (ended.lost()) {
                sink.lost(ended.reason());
            }
            throw new ConnectionClosedException(ended.reason());
        }
    }

    String gone(@Nullable String how) {
        return "the Player server at " + name + " has gone: " + how;
    }

    private static String text(DeviceAddress device) {
        return Interfaces.name(device.interfaceCode()) + ":" + device.index();
    }

    // ---- called by the reader

    void deliver(Frame frame) {
        if (space == null) {
            sink.frame(frame);
            return;
        }
        try {
            if (enqueueForSpace(frame)) {
                space.execute(() -> sink.frame(dequeueForSpace()));
            }
            if (frames.mode() == Delivery.PULL) {
                space.onIdle(() -> {
                    if (end.get() == null) {
                        answerOrLose(frame.tick());
                    }
                });
            }
        } catch (ActorStoppedException spaceIsClosed) {
            close(); // a client ends together with its actor space
        }
    }

    /**
     * Answers from an idle action. An exception there would reach no call of the program, which would then wait for
     * data for ever.
     */
    private void answerOrLose(long tick) {
        try {
            answered(tick);
        } catch (RequestFailedException e) {
            lose("data cannot be asked for: " + e.getMessage());
        } catch (ConnectionClosedException e) {
            LOG.log(Level.DEBUG, "{0}: {1}", name, e.getMessage()); // and the sink was notified
        }
    }

    @Nullable
    Duration silenceLimit() {
        return silenceLimit;
    }

    /**
     * Sends a request that every server answers at once. It runs on a separate thread, because sending may block; a
     * platform thread, because virtual threads may find no free carrier.
     */
    void sendKeepAlive() {
        Thread.ofPlatform().daemon().name("player-ask-" + name).start(() -> {
            Content keepAlive = PlayerDeviceCodec.encode(new PlayerRequest.DeviceList());
            try {
                send(PLAYER, keepAlive, pending.addUnawaited(PLAYER, keepAlive.subtype()), deadline());
            } catch (RuntimeException notSent) {
                LOG.log(Level.DEBUG, "{0} was not asked for a sign of life: {1}", name, notSent.getMessage());
            }
        });
    }

    /** The server is connected but has sent nothing for the whole limit. */
    void serverSilent(Duration limit) {
        sink.lost("the Player server at " + name + " is connected and silent: nothing has come from it for "
                + Deadline.nanos(limit) / 1_000_000 + " ms, and no answer to a request");
    }

    /**
     * Queues a frame for the space. False if the queue was full and the oldest frame was dropped; the turn queued for
     * that frame then delivers this one.
     */
    private boolean enqueueForSpace(Frame frame) {
        synchronized (forSpace) {
            forSpace.add(frame);
            if (forSpace.size() <= MAX_QUEUED_FRAMES) {
                return true;
            }
            forSpace.remove();
        }
        if (!overflowLogged) {
            overflowLogged = true;
            LOG.log(Level.WARNING, "{0}: actor space {1} is too slow, the oldest data are dropped", name, space);
        }
        return false;
    }

    private Frame dequeueForSpace() {
        synchronized (forSpace) {
            return forSpace.remove();
        }
    }

    void lose(String reason) {
        end(new End(reason, true));
    }

    private void end(End how) {
        if (!end.compareAndSet(null, how)) {
            return;
        }
        try {
            if (how.lost()) {
                sink.lost(how.reason());
            }
        } finally {
            try {
                socket.close(); // ends a blocked read or write
            } catch (IOException e) {
                LOG.log(Level.DEBUG, "{0}: {1}", name, e.getMessage());
            }
            pending.failAll(new ConnectionClosedException(how.reason()));
        }
    }
}
