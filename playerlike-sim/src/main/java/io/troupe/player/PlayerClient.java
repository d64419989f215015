package io.troupe.player;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerDevAddr;
import io.troupe.player.structures.player.PlayerDeviceDevlist;
import io.troupe.player.structures.player.PlayerDeviceDriverInfo;
import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.LineClosedException;
import io.troupe.player.wire.PlayerConnection;
import java.lang.System.Logger.Level;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.Supplier;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * A connection with a Player server, and the way to its devices.
 *
 * <p><b>Role.</b> Made by a program that drives robots; the names are those of the Player Java client. A server in this JVM is found by its port
 * without a socket (see {@link PlayerPorts}).
 * <p><b>Threads.</b> Any thread. In the threaded style ({@link #runThreaded}) new data appear by themselves and a thread keeps the JVM alive, as in the
 * original; else {@link #readAll} brings them. A client made on the thread of an actor space belongs to that space: what arrives is dispatched as a
 * turn of the space, {@code runThreaded} starts no thread, and {@link #nextData} says when to look.
 * <p><b>Order.</b> In lock step the world waits until its clients have answered a tick: by {@code readAll} waiting, by {@code isDataReady()} finding nothing
 * new where everything was seen or where it was asked in vain before, or, on an actor space, by the space having nothing left to do. In the threaded
 * style a frame appears as a whole, and in the call of {@code isDataReady()} by which the program waits for it: a program that uses its client from one
 * thread does the same every time, however fast anybody is. What it sends after its answer counts for the next tick. Use one client per thread. A program that
 * only reads {@code getData()} and never asks may meet the devices of one frame one after the other.
 * <p><b>Errors.</b> {@link PlayerException}, from waiting calls too when the server goes away.
 */
public class PlayerClient extends Thread implements PlayerConstants {
    private static final System.Logger LOG = System.getLogger(PlayerClient.class.getName());
    private static final Set<String> THIS_MACHINE = Set.of("localhost", "127.0.0.1", "::1");
    /** How long {@code isDataReady()} waits for news before it is false, so that a busy loop leaves the processor to the world. */
    private static final long PATIENCE_MILLIS = 1;

    private final @Nullable ActorSpace space = ActorSpace.current();
    private final List<PlayerDevice> devices = new CopyOnWriteArrayList<>();
    private final Incoming incoming = new Incoming(this::dispatch, this::answer, space != null);
    private final Latest<PlayerDeviceDevlist> deviceList = new Latest<>();
    private final Latest<PlayerDeviceDriverInfo> driverInfo = new Latest<>();
    private final PlayerConnection connection;
    private volatile boolean threaded;
    private volatile boolean pull;

    /**
     * Connects.
     *
     * @throws PlayerException if there is no server
     */
    public PlayerClient(String serverName, int portNumber) {
        super("player-client-" + portNumber);
        String failed = "[PlayerClient]: Error in PlayerClient init: ";
        if (!THIS_MACHINE.contains(serverName)) {
            throw new PlayerException(failed + serverName + ":" + portNumber
                    + " is not in this JVM, and other machines are not offered yet");
        }
        var server = PlayerPorts.find(portNumber)
                .orElseThrow(() -> new PlayerException(failed + "no server in this JVM at " + serverName + ":"
                        + portNumber + "; open ports: " + PlayerPorts.list()));
        connection = calling(() -> server.connect(incoming, space));
        LOG.log(Level.DEBUG, "{0}:{1,number,#}: {2}", serverName, portNumber, server.banner());
    }

    // ---- devices

    public Position2DInterface requestInterfacePosition2D(int index, int access) {
        return request(new Position2DInterface(this), Interfaces.POSITION2D, index, access);
    }

    public SonarInterface requestInterfaceSonar(int index, int access) {
        return request(new SonarInterface(this), Interfaces.SONAR, index, access);
    }

    public BlobfinderInterface requestInterfaceBlobfinder(int index, int access) {
        return request(new BlobfinderInterface(this), Interfaces.BLOBFINDER, index, access);
    }

    /** The same by the interface's code, for example {@code PLAYER_SONAR_CODE}. */
    public PlayerDevice requestInterface(int type, int index, int access) {
        return switch (type) {
            case PLAYER_POSITION2D_CODE -> requestInterfacePosition2D(index, access);
            case PLAYER_SONAR_CODE -> requestInterfaceSonar(index, access);
            case PLAYER_BLOBFINDER_CODE -> requestInterfaceBlobfinder(index, access);
            default ->
                throw new PlayerException("[PlayerClient] " + Interfaces.name(type) + ":" + index
                        + " was requested; this client offers position2d, sonar and blobfinder");
        };
    }

    private <D extends PlayerDevice> D request(D device, Interfaces type, int index, int access) {
        var offered = calling(connection::devices);
        DeviceAddress address = offered.stream()
                .filter(each -> each.interfaceCode() == type.code() && each.index() == index)
                .findFirst()
                .orElseThrow(
                        () -> new PlayerException("[PlayerClient] Requested device " + type.playerName() + ":" + index
                                + " is not in the device list. It has: "
                                + offered.stream().map(PlayerClient::name).collect(Collectors.joining(", "))));
        device.bind(address, (byte) access, calling(() -> connection.driverName(address)));
        switch (access) {
            case PLAYER_OPEN_MODE -> {
                devices.add(device); // before its first data can come
                tell(() -> connection.subscribe(address));
            }
            case PLAYER_CLOSE_MODE -> {
                tell(() -> connection.unsubscribe(address));
                devices.removeIf(each -> each.address().equals(address));
            }
            default ->
                throw new PlayerException("access mode of " + device + " is " + access
                        + ", expected PLAYER_OPEN_MODE (1) or PLAYER_CLOSE_MODE (2)");
        }
        return device;
    }

    private static String name(DeviceAddress address) {
        return Interfaces.name(address.interfaceCode()) + ":" + address.index();
    }

    /** Asks which devices the server has; the answer is there when this returns. */
    public void requestDeviceList() {
        var answer = new PlayerDeviceDevlist();
        answer.setDevList(
                calling(connection::devices).stream().map(PlayerDevice::convert).toArray(PlayerDevAddr[]::new));
        answer.setDeviceCount(answer.getDevList().length);
        deviceList.put(answer);
    }

    /** True once for each answer to {@link #requestDeviceList}. */
    public boolean isReadyPDDList() {
        return deviceList.takeNew();
    }

    /** The answer to {@link #requestDeviceList}, or null before. */
    public @Nullable PlayerDeviceDevlist getPDDList() {
        return deviceList.get();
    }

    /** Asks which driver is behind a device; the answer is there when this returns. */
    public void requestDriverInfo(PlayerDevAddr device) {
        var answer = new PlayerDeviceDriverInfo();
        answer.setAddr(device);
        answer.setDriverName(calling(() -> connection.driverName(PlayerDevice.convert(device))));
        driverInfo.put(answer);
    }

    /** True once for each answer to {@link #requestDriverInfo}. */
    public boolean isReadyPDDI() {
        return driverInfo.takeNew();
    }

    /** The answer to {@link #requestDriverInfo}, or null before. */
    public @Nullable PlayerDeviceDriverInfo getPDDI() {
        return driverInfo.get();
    }

    // ---- waiting for data

    /**
     * Lets data appear by themselves, and keeps the JVM alive until {@link #close} or {@link #setNotThreaded}. On an actor space both come from the space.
     * A second call only logs a warning.
     *
     * <p>In lock step there is nothing to read ahead, so the pauses that a program asks for here do not delay its data; a program that looks for news by
     * {@code isDataReady()} finds them in that call, and the thread shows them to one that does not.
     *
     * @param millis of no effect; the original paused so long after each message
     * @param nanos of no effect
     */
    public void runThreaded(long millis, int nanos) {
        if (threaded) {
            LOG.log(Level.WARNING, "{0} is threaded already", getName());
            return;
        }
        if (space == null && getState() != State.NEW) {
            throw new PlayerException(
                    getName() + " was threaded before: a thread starts once, make a new PlayerClient");
        }
        incoming.begin();
        threaded = true;
        if (space == null) {
            start();
        }
    }

    /** Ends what {@link #runThreaded} began, and waits until it has ended. */
    public void setNotThreaded() {
        if (!threaded) {
            return;
        }
        threaded = false;
        incoming.wakeAll();
        if (space == null && Thread.currentThread() != this) {
            try {
                join();
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
    }

    /** What the thread of {@link #runThreaded} does. */
    @Override
    public void run() {
        try {
            incoming.showWhile(() -> threaded);
        } catch (PlayerException serverHasGone) {
            // every call the program waits in says so too
            LOG.log(Level.DEBUG, "{0}: no more data: {1}", getName(), serverHasGone.getMessage());
        }
    }

    /**
     * Dispatches what arrives, in the style without a thread: one message (push mode), or all of a frame (pull mode); waits until there is one.
     *
     * @return the type of the last message read: {@code PLAYER_MSGTYPE_DATA} or {@code PLAYER_MSGTYPE_SYNCH}; 0 at once if the client is threaded
     * @throws PlayerException if the server has gone, or the client belongs to an actor space and is not threaded
     */
    public int readAll() {
        if (threaded) {
            return 0;
        }
        if (space != null) {
            throw new PlayerException(
                    "readAll() would hold the thread of actor space " + space + ": use nextData() there");
        }
        incoming.read(pull);
        return pull ? PLAYER_MSGTYPE_SYNCH : PLAYER_MSGTYPE_DATA;
    }

    /** Asks for data, as the pull mode needs it. {@link #readAll} and the threaded style do that by themselves, so there is nothing left to do. */
    public void requestData() {
        calling(connection::devices); // throws if the server has gone
    }

    /** Chooses between {@code PLAYER_DATAMODE_PUSH} (the default) and {@code PLAYER_DATAMODE_PULL}. */
    public void requestDataDeliveryMode(int mode) {
        if (mode != PLAYER_DATAMODE_PUSH && mode != PLAYER_DATAMODE_PULL) {
            throw new PlayerException("data delivery mode is " + mode + ", expected 1 (push) or 2 (pull)");
        }
        pull = mode == PLAYER_DATAMODE_PULL;
    }

    /** Not offered yet: in lock step at most one frame waits, so there is nothing to replace. */
    public void requestAddReplaceRule(int interf, int index, int type, int subtype, int replace) {
        throw new PlayerException("requestAddReplaceRule is not offered yet");
    }

    /**
     * Fulfilled when the next frame is complete: all subscribed devices have new data. Our addition to the Player client, for actors; instead of a loop around
     * {@code isDataReady()}. Off actor spaces, asking for it answers the tick.
     */
    public Promise<@Nullable Void> nextData() {
        return incoming.next();
    }

    /** Stops the thread and disconnects; every later call, and every call that waits, throws {@link PlayerException}. */
    public void close() {
        incoming.lost("[PlayerClient] this client is closed");
        setNotThreaded();
        connection.close();
    }

    // ---- for devices

    /** Whether a device has news; where it has none, this may be how the program waits. */
    boolean findsNews(Latest<?> asked) {
        if (threaded || space != null) {
            return incoming.poll(asked, this::everythingSeen, PATIENCE_MILLIS);
        }
        boolean news = incoming.takeNew(asked);
        if (!news) {
            Thread.onSpinWait();
        }
        return news;
    }

    private boolean everythingSeen() {
        for (var device : devices) {
            if (device.latest().isNew()) {
                return false;
            }
        }
        return true;
    }

    void command(DeviceAddress device, DeviceCommand command) {
        tell(() -> connection.command(device, command));
    }

    DeviceReply request(DeviceAddress device, DeviceRequest request) {
        return calling(() -> connection.request(device, request));
    }

    private void answer(long tick) {
        tell(() -> connection.answered(tick));
    }

    private void dispatch(DataMessage message) {
        for (var device : devices) {
            if (device.address().equals(message.from())) {
                device.accept(message.timeSeconds(), message.data());
            }
        }
    }

    private static void tell(Runnable call) {
        calling(() -> {
            call.run();
            return true;
        });
    }

    private static <T> T calling(Supplier<T> call) {
        try {
            return call.get();
        } catch (LineClosedException | IllegalArgumentException refused) {
            throw new PlayerException(refused.getMessage(), refused);
        }
    }
}
