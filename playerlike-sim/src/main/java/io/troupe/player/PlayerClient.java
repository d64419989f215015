package io.troupe.player;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.LineClosedException;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.PlayerServer;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Supplier;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * A connection with a Player server, and the way to its devices.
 *
 * <p><b>Role.</b> Made by a program that drives robots; the names are those of the Player Java client. A server in this JVM is found by its port
 * without a socket (see {@link PlayerPorts}).
 * <p><b>Threads.</b> Any thread. In the threaded style ({@link #runThreaded}) a thread of its own, which keeps the JVM alive, dispatches what arrives; else
 * {@link #readAll} does. A client made on the thread of an actor space belongs to that space: what arrives is dispatched as a turn of the space,
 * {@code runThreaded} starts no thread, and {@link #nextData} says when to look.
 * <p><b>Order.</b> In lock step the world waits until its clients have answered a tick: by {@code readAll} waiting, by {@code isDataReady()} answering false,
 * or, on an actor space, by the space having nothing left to do.
 * <p><b>Errors.</b> {@link PlayerException}, from waiting calls too when the server goes away.
 */
public class PlayerClient extends Thread implements PlayerConstants {
    private static final Set<String> THIS_MACHINE = Set.of("localhost", "127.0.0.1", "::1");
    /** How long {@code isDataReady()} waits for news before it answers false, so that a busy loop leaves the processor to the world. */
    private static final long PATIENCE_MILLIS = 1;

    private final @Nullable ActorSpace space = ActorSpace.current();
    private final Map<DeviceAddress, PlayerDevice> devices = new ConcurrentHashMap<>();
    private final Incoming incoming = new Incoming(this::dispatch, space != null);
    private final PlayerConnection connection;
    private volatile boolean threaded;
    private volatile int dataMode = PLAYER_DATAMODE_PUSH;
    private long pauseNanos = -1;

    /**
     * Connects.
     *
     * @throws PlayerException if there is no server
     */
    public PlayerClient(String serverName, int portNumber) {
        super("player-client-" + portNumber);
        if (!THIS_MACHINE.contains(serverName)) {
            throw new PlayerException("[PlayerClient]: Error in PlayerClient init: " + serverName + ":" + portNumber
                    + " is not in this JVM, and other machines are not offered yet");
        }
        PlayerServer server = PlayerPorts.find(portNumber)
                .orElseThrow(() ->
                        new PlayerException("[PlayerClient]: Error in PlayerClient init: no server in this JVM at "
                                + serverName + ":" + portNumber + "; open ports: " + PlayerPorts.list()));
        connection = server.connect(incoming, space);
    }

    // ---- devices

    public Position2DInterface requestInterfacePosition2D(int index, int access) {
        return subscribe(new Position2DInterface(this), Interfaces.POSITION2D, index, access);
    }

    public SonarInterface requestInterfaceSonar(int index, int access) {
        return subscribe(new SonarInterface(this), Interfaces.SONAR, index, access);
    }

    public BlobfinderInterface requestInterfaceBlobfinder(int index, int access) {
        return subscribe(new BlobfinderInterface(this), Interfaces.BLOBFINDER, index, access);
    }

    private <D extends PlayerDevice> D subscribe(D device, Interfaces type, int index, int access) {
        if (access != PLAYER_OPEN_MODE) {
            throw new PlayerException("access mode of " + type.playerName() + ":" + index + " is " + access
                    + ", expected PLAYER_OPEN_MODE (" + PLAYER_OPEN_MODE + ")");
        }
        var offered = calling(connection::devices);
        DeviceAddress address = offered.stream()
                .filter(each -> each.interfaceCode() == type.code() && each.index() == index)
                .findFirst()
                .orElseThrow(
                        () -> new PlayerException("[PlayerClient] Requested device " + type.playerName() + ":" + index
                                + " is not in the device list. It has: "
                                + offered.stream().map(PlayerClient::name).collect(Collectors.joining(", "))));
        device.bind(address);
        devices.put(address, device);
        calling(() -> {
            connection.subscribe(address);
            return address;
        });
        return device;
    }

    private static String name(DeviceAddress address) {
        return Interfaces.name(address.interfaceCode()) + ":" + address.index();
    }

    // ---- waiting for data

    /**
     * Lets a thread of its own dispatch what arrives; on an actor space that is the space's thread already. A second call changes nothing.
     *
     * @param millis pause after each message; negative = none
     * @param nanos added to the pause if positive
     */
    public void runThreaded(long millis, int nanos) {
        if (space != null || threaded) {
            return;
        }
        pauseNanos = millis < 0 ? -1 : millis * 1_000_000 + Math.max(0, nanos);
        threaded = true;
        start();
    }

    /** Ends the thread of {@link #runThreaded} and waits until it has ended. */
    public void setNotThreaded() {
        if (!threaded) {
            return;
        }
        threaded = false;
        incoming.wakeAll();
        if (Thread.currentThread() != this) {
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
            while (threaded) {
                incoming.awaitMessage(() -> threaded);
                if (threaded && incoming.dispatchNext() && pauseNanos > 0) {
                    LockSupport.parkNanos(this, pauseNanos);
                }
            }
        } catch (PlayerException serverHasGone) {
            System.getLogger(PlayerClient.class.getName())
                    .log(System.Logger.Level.DEBUG, "no more data: {0}", serverHasGone.getMessage());
        }
    }

    /**
     * Dispatches what arrives, in the style without a thread: one message (push mode), or all of a frame (pull mode); waits until there is one.
     *
     * @return the type of the last message read: {@code PLAYER_MSGTYPE_DATA} or {@code PLAYER_MSGTYPE_SYNCH}; 0 at once if the client is threaded
     */
    public int readAll() {
        if (threaded || space != null) {
            return 0;
        }
        boolean pull = dataMode == PLAYER_DATAMODE_PULL;
        do {
            if (incoming.isEmpty()) {
                answer(incoming.deliveredTick());
            }
            incoming.awaitMessage(() -> true);
            incoming.dispatchNext();
        } while (pull && !incoming.isEmpty());
        return pull ? PLAYER_MSGTYPE_SYNCH : PLAYER_MSGTYPE_DATA;
    }

    /** Asks for data, as the pull mode needs it; {@link #readAll} does it by itself. */
    public void requestData() {
        if (!threaded && incoming.isEmpty()) {
            answer(incoming.deliveredTick());
        }
    }

    /** Chooses between {@code PLAYER_DATAMODE_PUSH} (the default) and {@code PLAYER_DATAMODE_PULL}. */
    public void requestDataDeliveryMode(int mode) {
        if (mode != PLAYER_DATAMODE_PUSH && mode != PLAYER_DATAMODE_PULL) {
            throw new PlayerException("data delivery mode is " + mode + ", expected 1 (push) or 2 (pull)");
        }
        dataMode = mode;
    }

    /**
     * Fulfilled when the next frame is complete: all subscribed devices have new data. Our addition to the Player client, for actors; instead of a loop around
     * {@code isDataReady()}.
     */
    public Promise<@Nullable Void> nextData() {
        long tick = incoming.deliveredTick();
        var next = incoming.next();
        if (space == null && !next.isDone()) {
            answer(tick);
        }
        return next;
    }

    /** Stops the thread and disconnects; every later call, and every call that waits, throws {@link PlayerException}. */
    public void close() {
        incoming.lost("[PlayerClient] this client is closed");
        setNotThreaded();
        connection.close();
    }

    // ---- for devices

    /** A device has no news: answers the tick, gives the world a moment, and looks again. */
    boolean awaitNewer(Latest<?> latest) {
        long tick = incoming.deliveredTick();
        if (latest.takeNew()) {
            return true;
        }
        answer(tick);
        if (space != null) {
            return false;
        }
        incoming.awaitTickAfter(tick, PATIENCE_MILLIS);
        return latest.takeNew();
    }

    void command(DeviceAddress device, DeviceCommand command) {
        calling(() -> {
            connection.command(device, command);
            return device;
        });
    }

    DeviceReply request(DeviceAddress device, DeviceRequest request) {
        return calling(() -> connection.request(device, request));
    }

    String driverName(DeviceAddress device) {
        return calling(() -> connection.driverName(device));
    }

    private void answer(long tick) {
        calling(() -> {
            connection.answered(tick);
            return tick;
        });
    }

    private void dispatch(DataMessage message) {
        PlayerDevice device = devices.get(message.from());
        if (device != null) {
            device.accept(message.timeSeconds(), message.data());
        }
    }

    private static <T> T calling(Supplier<T> call) {
        try {
            return call.get();
        } catch (LineClosedException closed) {
            throw new PlayerException(closed.getMessage(), closed);
        }
    }
}
