package io.troupe.player;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.player.structures.PlayerDevAddr;
import io.troupe.player.structures.player.PlayerDeviceDevlist;
import io.troupe.player.structures.player.PlayerDeviceDriverInfo;
import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.player.wire.Delivery;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.PlayerServer;
import io.troupe.player.wire.RemoteServer;
import io.troupe.player.wire.ReplaceRule;
import io.troupe.player.wire.RequestFailedException;
import java.lang.System.Logger.Level;
import java.time.Duration;
import java.util.List;
import java.util.Set;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.logging.Logger;
import org.jspecify.annotations.Nullable;

/**
 * A connection to a Player server that gives access to its devices.
 *
 * {@snippet :
 * PlayerClient robot = new PlayerClient("localhost", port);
 * SonarInterface sonar = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
 * robot.runThreaded(-1, -1);
 * while (!sonar.isDataReady())
 *     ;
 * float[] ranges = sonar.getData().getRanges();
 * robot.close();
 * }
 *
 * <p><b>Role.</b> Created by a program that drives robots; the names are those of the Player Java client. A server in
 * this JVM is found by its port and needs no socket (see {@link PlayerPorts}). Any other server, ours or a real Player
 * 3 server, is connected over TCP.
 *
 * <p><b>Threads.</b> Any thread. In the threaded style ({@link #runThreaded}) new data appear without a call, and a
 * thread keeps the JVM alive, as in the original. Otherwise {@link #readAll} fetches them. A client created on the
 * thread of an actor space belongs to that space: arriving data are dispatched as a turn of the space,
 * {@code runThreaded} starts no thread, and {@link #nextData} signals new data.
 *
 * <p><b>Order.</b> In lock step the world waits until each client has answered the tick. A client answers when
 * {@code readAll} waits, when {@code isDataReady()} returns false after all data were seen, or when it returns false
 * for the second time on the same device. On an actor space a client answers when the space has no more work. In the
 * threaded style a frame appears as a whole, in the {@code isDataReady()} call by which the program waits. So a program
 * that uses its client from one thread behaves the same in every run, whatever the speed of its threads. Commands sent
 * after the answer count for the next tick. Use one client per thread. A program that only calls {@code getData()}, and
 * never {@code isDataReady()}, may see the devices of one frame change one after the other.
 *
 * <p><b>Errors.</b> {@link PlayerException}; waiting calls throw it too when the connection is lost. The client does
 * not reconnect; that is the program's decision.
 */
public class PlayerClient extends SupportedInterfaces {
    private static final System.Logger LOG = System.getLogger(PlayerClient.class.getName());
    private static final Set<String> THIS_MACHINE = Set.of("localhost", "127.0.0.1", "::1");
    /**
     * How long {@code isDataReady()} waits for data before it returns false, so that a busy loop leaves the processor
     * to the world.
     */
    private static final long PATIENCE_MILLIS = 1;

    private static final long REPLY_LIMIT_MILLIS = 10_000;

    private final @Nullable ActorSpace space = ActorSpace.current();
    private final ClientInbox inbox = new ClientInbox(subscriptions::dispatch, this::answer, space != null);
    private final PlayerConnection connection;
    private final Object threading = new Object();
    private volatile boolean threaded;
    private volatile boolean pull;
    private final AtomicBoolean commandLimitWasRefused = new AtomicBoolean();
    final LatestValue<Devices> devices = new LatestValue<>();
    private final LatestValue<PlayerDeviceDriverInfo> driverInfo = new LatestValue<>();
    private final int port;
    private volatile long readTimeoutMillis = REPLY_LIMIT_MILLIS;

    /**
     * Connects and requests the list of devices; {@link #getPDDList} returns it from the start.
     *
     * @throws PlayerException if there is no server
     */
    public PlayerClient(String serverName, int portNumber) {
        super("player-client-" + portNumber);
        port = portNumber;
        boolean thisMachine = THIS_MACHINE.contains(serverName);
        PlayerServer server = thisMachine ? PlayerPorts.find(portNumber).orElse(null) : null;
        try {
            if (server == null) {
                server = new RemoteServer(serverName, portNumber);
            }
            connection = server.connect(inbox, space);
            devices.put(new Devices(connection.devices())); // the connection has fetched the list already
        } catch (ConnectionClosedException | RequestFailedException | IllegalArgumentException e) {
            throw new PlayerException(
                    "[PlayerClient]: Error in PlayerClient init: " + e.getMessage()
                            + (thisMachine ? " (ports of worlds in this JVM: " + PlayerPorts.list() + ")" : ""),
                    e);
        }
        LOG.log(Level.DEBUG, "{0}:{1,number,#}: {2}", serverName, portNumber, server.banner());
    }

    // ---- waiting for data

    /**
     * Starts the threaded style: data appear without further calls, and the JVM stays alive until {@link #close} or
     * {@link #setNotThreaded}. On an actor space both are done by the space. A second call only logs a warning.
     *
     * <p>In lock step nothing can be read ahead, so the pauses given here do not delay data. A program that polls
     * {@code isDataReady()} finds new data in that call; for any other program the thread makes them visible.
     *
     * @param millis no effect; the original pauses this long after each message
     * @param nanos no effect
     */
    public void runThreaded(long millis, int nanos) {
        synchronized (threading) { // only one of several threads starts it
            if (threaded) {
                LOG.log(Level.WARNING, "{0} is threaded already", getName());
                return;
            }
            if (space == null && getState() != State.NEW) {
                throw new PlayerException(
                        getName() + " was threaded before: a thread starts once, make a new PlayerClient");
            }
            inbox.begin();
            threaded = true;
            if (space == null) {
                start();
            }
        }
    }

    /** Ends the threaded style; returns when its thread has ended. */
    public void setNotThreaded() {
        synchronized (threading) {
            if (!threaded) {
                return;
            }
            threaded = false;
        }
        inbox.wakeAll();
        if (space == null && Thread.currentThread() != this) {
            try {
                join();
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
    }

    /** Body of the thread that {@link #runThreaded} starts. */
    @Override
    public void run() {
        try {
            inbox.showWhile(() -> threaded);
        } catch (PlayerException serverHasGone) {
            // each waiting call of the program throws the same error
            LOG.log(Level.DEBUG, "{0}: no more data: {1}", getName(), serverHasGone.getMessage());
        } catch (RuntimeException | Error e) { // otherwise the program would wait for data for ever
            inbox.lost("[PlayerClient] the thread of " + getName() + " has failed: " + e);
            throw e;
        }
    }

    /**
     * Dispatches arrived messages in the style without a thread: one message (push mode) or a whole frame (pull mode).
     * Waits if there is none.
     *
     * @return the type of the last message read: {@code PLAYER_MSGTYPE_DATA} or {@code PLAYER_MSGTYPE_SYNCH}, or in
     *     push mode the type of a reply if nothing else is queued; 0 at once if the client is threaded
     * @throws PlayerException if the connection is lost, or if the client belongs to an actor space and is not threaded
     */
    public int readAll() {
        if (threaded) {
            return 0;
        }
        if (space != null) {
            throw new PlayerException(
                    "readAll() would hold the thread of actor space " + space + ": use nextData() there");
        }
        return inbox.read(pull);
    }

    /**
     * Requests data in pull mode. {@link #readAll} and the threaded style already do that, so this only checks the
     * connection.
     */
    public void requestData() {
        compute(connection::devices); // throws if the connection is lost
    }

    /**
     * Selects {@code PLAYER_DATAMODE_PUSH} (the default) or {@code PLAYER_DATAMODE_PULL}.
     *
     * <p>Over a socket a client is in lock step only in pull mode, selected before its first subscription. A world of
     * ours that has had a push client keeps pace with real time. In this JVM both modes are in lock step.
     */
    public void requestDataDeliveryMode(int mode) {
        if (mode != PLAYER_DATAMODE_PUSH && mode != PLAYER_DATAMODE_PULL) {
            throw new PlayerException("data delivery mode is " + mode + ", expected 1 (push) or 2 (pull)");
        }
        execute(() -> connection.delivery(mode == PLAYER_DATAMODE_PULL ? Delivery.PULL : Delivery.PUSH));
        pull = mode == PLAYER_DATAMODE_PULL;
    }

    /**
     * Completes with the next complete frame: all subscribed devices have new data. An addition to the Player client,
     * for actors, which use it instead of a loop around {@code isDataReady()}. Outside actor spaces this call answers
     * the tick.
     */
    public Promise<@Nullable Void> nextData() {
        return inbox.next();
    }

    /**
     * Sets a limit after which a connected but silent server counts as lost. If nothing arrives for half of the limit,
     * the client sends a request that every server answers. If nothing arrives in the other half either, every waiting
     * call and every later one throws {@link PlayerException}. Null, the default, sets no limit. Commands are still
     * sent until {@link #close}. An addition to the Player client, which waits without limit.
     *
     * <p>Measured in wall-clock time. A server that is paused, or whose lock step waits for another client, still
     * answers and so is not silent. A server in this JVM is never silent.
     */
    public void setSilenceLimit(@Nullable Duration limit) {
        if (limit != null && limit.compareTo(Duration.ofMillis(2)) < 0) {
            throw new PlayerException("silence limit is " + limit + ", expected 2 ms or more, or null for none");
        }
        execute(() -> connection.silenceLimit(limit));
    }

    /** Stops the thread and disconnects. Every waiting call and every later one throws {@link PlayerException}. */
    public void close() {
        inbox.lost("[PlayerClient] this client is closed");
        setNotThreaded();
        connection.close();
    }

    // ---- requests to the server itself

    /** Requests the list of devices; the reply has arrived when this call returns. */
    public void requestDeviceList() {
        devices.put(new Devices(compute(connection::devices)));
    }

    /** True once for each reply to {@link #requestDeviceList}, and once for the list that a new client starts with. */
    public boolean isReadyPDDList() {
        return devices.takeNew();
    }

    /** The server's devices: the list from connecting, or the newest reply to {@link #requestDeviceList}. */
    public @Nullable PlayerDeviceDevlist getPDDList() {
        Devices newest = devices.get();
        return newest == null ? null : newest.list();
    }

    /** Requests the driver of a device; the reply has arrived when this call returns. */
    public void requestDriverInfo(PlayerDevAddr device) {
        var answer = new PlayerDeviceDriverInfo();
        answer.setAddr(device);
        answer.setDriverName(compute(() -> connection.driverName(PlayerDevice.convert(device))));
        driverInfo.put(answer);
    }

    /** True once for each reply to {@link #requestDriverInfo}. */
    public boolean isReadyPDDI() {
        return driverInfo.takeNew();
    }

    /** The newest reply to {@link #requestDriverInfo}, or null before the first. */
    public @Nullable PlayerDeviceDriverInfo getPDDI() {
        return driverInfo.get();
    }

    /**
     * Sets what the server does with messages queued for this client; the newest matching rule applies.
     *
     * @param interf code of an interface; -1 in this and the next three parameters matches everything
     * @param type type of message, for example {@code PLAYER_MSGTYPE_DATA}
     * @param replace 0: messages queue up; 1: a new message replaces the newest queued one of its kind; 2: messages are
     *     dropped
     */
    public void requestAddReplaceRule(int interf, int index, int type, int subtype, int replace) {
        if (replace < ReplaceRule.ACCEPT || replace > ReplaceRule.IGNORE) {
            throw new PlayerException("replace is " + replace + ", expected 0 (accept), 1 (replace) or 2 (ignore)");
        }
        execute(() -> connection.replace(new ReplaceRule(interf, index, type, subtype, replace)));
    }

    /** Only logs a warning: no Player 3 server authenticates its clients, so nothing is sent. */
    public void requestAuthentication(byte[] key) {
        notServed("authentication");
    }

    /** Always false: see {@link #requestAuthentication}. */
    public boolean isAuthenticated() {
        return false;
    }

    /** Only logs a warning: no Player 3 server maps robot names to ports, so nothing is sent. */
    public void requestNameService(char[] name) {
        notServed("name service");
    }

    /** Always false: see {@link #requestNameService}. */
    public boolean isReadyPortNumber() {
        return false;
    }

    /** The port that this client is connected to. */
    public int getPortNumber() {
        return port;
    }

    /**
     * Only logs a warning: Player 3 has no such request. Its servers send their identification when a client connects;
     * the client logs it.
     */
    public void requestIdent() {
        notServed("identification");
    }

    private void notServed(String what) {
        LOG.log(Level.WARNING, "{0}: Player 3 servers have no {1}", getName(), what);
    }

    /**
     * Limit of a call in milliseconds, for sending and for waiting for the reply together; 10,000 by default. Waiting
     * for data has no limit.
     */
    public long getReadTimeout() {
        return readTimeoutMillis;
    }

    public void setReadTimeout(long millis) {
        if (millis < 1) {
            throw new PlayerException("read timeout is " + millis + " ms, expected at least 1");
        }
        execute(() -> connection.replyLimit(Duration.ofMillis(millis)));
        readTimeoutMillis = millis;
    }

    /** The logger of a client's warnings. */
    public Logger getLogger() {
        return Logger.getLogger(PlayerClient.class.getName());
    }

    // ---- called by devices

    /** True if a device has new data; an unsuccessful call may answer the tick. */
    boolean hasNewData(LatestValue<?> asked) {
        if (threaded || space != null) {
            return inbox.poll(asked, subscriptions::everythingSeen, PATIENCE_MILLIS);
        }
        boolean news = inbox.takeNew(asked);
        if (!news) {
            Thread.onSpinWait();
        }
        return news;
    }

    /** True if the reply to a request has arrived. */
    boolean hasReply(LatestValue<?> asked) {
        return inbox.takeReply(asked, PATIENCE_MILLIS);
    }

    void command(DeviceAddress device, DeviceCommand command) {
        execute(() -> connection.command(device, command));
    }

    void request(PlayerDevice device, DeviceRequest request) {
        var address = device.address();
        inbox.requestBegins();
        try {
            execute(() -> connection.request(
                    address,
                    request,
                    reply -> inbox.requestEnds(
                            reply instanceof DeviceReply.Nack ? PLAYER_MSGTYPE_RESP_NACK : PLAYER_MSGTYPE_RESP_ACK,
                            () -> device.receive(request, reply))));
        } catch (PlayerException notSent) {
            inbox.requestFails();
            throw notSent;
        }
    }

    /** Logged once for all robots of this client. */
    void commandLimitRefused(Position2DInterface device, String reason) {
        if (commandLimitWasRefused.compareAndSet(false, true)) {
            LOG.log(
                    Level.INFO,
                    "{0}: {1} does not know limits of commands, so the server decides when a robot stops whose driver is"
                            + " silent: {2}",
                    getName(),
                    device,
                    reason);
        }
    }

    private void answer(long tick) {
        execute(() -> connection.answered(tick));
    }

    @Override
    PlayerClient client() {
        return this;
    }

    @Override
    PlayerConnection connection() {
        return connection;
    }

    /**
     * The devices of a server, converted when first read: a thousand clients of a world with three thousand devices
     * share one list of addresses.
     */
    static final class Devices {
        private final List<DeviceAddress> addresses;
        private @Nullable PlayerDeviceDevlist converted;

        Devices(List<DeviceAddress> addresses) {
            this.addresses = addresses;
        }

        synchronized PlayerDeviceDevlist list() {
            PlayerDeviceDevlist list = converted;
            if (list == null) {
                list = new PlayerDeviceDevlist();
                list.setDevList(addresses.stream().map(PlayerDevice::convert).toArray(PlayerDevAddr[]::new));
                list.setDeviceCount(list.getDevList().length);
                converted = list;
            }
            return list;
        }
    }
}
