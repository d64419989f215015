package io.troupe.player;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.player.wire.Delivery;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.LineClosedException;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.PlayerServer;
import io.troupe.player.wire.RemoteServer;
import io.troupe.player.wire.RequestFailedException;
import java.lang.System.Logger.Level;
import java.time.Duration;
import java.util.Set;
import java.util.concurrent.atomic.AtomicBoolean;
import org.jspecify.annotations.Nullable;

/**
 * A connection with a Player server, and the way to its devices.
 *
 * <p><b>Role.</b> Made by a program that drives robots; the names are those of the Player Java client. A server in this
 * JVM is found by its port without a socket (see {@link PlayerPorts}); every other one, ours or a real one of Player 3,
 * is connected over TCP.
 *
 * <p><b>Threads.</b> Any thread. In the threaded style ({@link #runThreaded}) new data appear by themselves and a
 * thread keeps the JVM alive, as in the original; else {@link #readAll} brings them. A client made on the thread of an
 * actor space belongs to that space: what arrives is dispatched as a turn of the space, {@code runThreaded} starts no
 * thread, and {@link #nextData} says when to look.
 *
 * <p><b>Order.</b> In lock step the world waits until its clients have answered a tick: by {@code readAll} waiting, by
 * {@code isDataReady()} finding nothing new where everything was seen or where it was asked in vain before, or, on an
 * actor space, by the space having nothing left to do. In the threaded style a frame appears as a whole, and in the
 * call of {@code isDataReady()} by which the program waits for it: a program that uses its client from one thread does
 * the same every time, however fast anybody is. What it sends after its answer counts for the next tick. Use one client
 * per thread. A program that only reads {@code getData()} and never asks may meet the devices of one frame one after
 * the other.
 *
 * <p><b>Errors.</b> {@link PlayerException}, from waiting calls too when the server goes away. Nothing reconnects: that
 * is for the program to decide.
 */
public class PlayerClient extends ServerInquiries {
    private static final System.Logger LOG = System.getLogger(PlayerClient.class.getName());
    private static final Set<String> THIS_MACHINE = Set.of("localhost", "127.0.0.1", "::1");
    /**
     * How long {@code isDataReady()} waits for news before it is false, so that a busy loop leaves the processor to the
     * world.
     */
    private static final long PATIENCE_MILLIS = 1;

    private final @Nullable ActorSpace space = ActorSpace.current();
    private final Incoming incoming = new Incoming(subscriptions::dispatch, this::answer, space != null);
    private final PlayerConnection connection;
    private final Object threading = new Object();
    private volatile boolean threaded;
    private volatile boolean pull;
    private final AtomicBoolean commandLimitWasRefused = new AtomicBoolean();

    /**
     * Connects, and asks for the server's devices: {@link #getPDDList} has them from the beginning.
     *
     * @throws PlayerException if there is no server
     */
    public PlayerClient(String serverName, int portNumber) {
        super("player-client-" + portNumber, portNumber);
        boolean thisMachine = THIS_MACHINE.contains(serverName);
        PlayerServer server = thisMachine ? PlayerPorts.find(portNumber).orElse(null) : null;
        try {
            if (server == null) {
                server = new RemoteServer(serverName, portNumber);
            }
            connection = server.connect(incoming, space);
            devices.put(new Devices(connection.devices())); // connecting has asked for them
        } catch (LineClosedException | RequestFailedException | IllegalArgumentException e) {
            throw new PlayerException(
                    "[PlayerClient]: Error in PlayerClient init: " + e.getMessage()
                            + (thisMachine ? " (ports of worlds in this JVM: " + PlayerPorts.list() + ")" : ""),
                    e);
        }
        LOG.log(Level.DEBUG, "{0}:{1,number,#}: {2}", serverName, portNumber, server.banner());
    }

    // ---- waiting for data

    /**
     * Lets data appear by themselves, and keeps the JVM alive until {@link #close} or {@link #setNotThreaded}. On an
     * actor space both come from the space. A second call only logs a warning.
     *
     * <p>In lock step there is nothing to read ahead, so the pauses that a program asks for here do not delay its data;
     * a program that looks for news by {@code isDataReady()} finds them in that call, and the thread shows them to one
     * that does not.
     *
     * @param millis of no effect; the original paused so long after each message
     * @param nanos of no effect
     */
    public void runThreaded(long millis, int nanos) {
        synchronized (threading) { // of several threads, one starts it
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
    }

    /** Ends what {@link #runThreaded} began, and waits until it has ended. */
    public void setNotThreaded() {
        synchronized (threading) {
            if (!threaded) {
                return;
            }
            threaded = false;
        }
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
        } catch (RuntimeException | Error e) { // or the program would wait for data that nobody shows to it
            incoming.lost("[PlayerClient] the thread of " + getName() + " has failed: " + e);
            throw e;
        }
    }

    /**
     * Dispatches what arrives, in the style without a thread: one message (push mode), or all of a frame (pull mode);
     * waits until there is one.
     *
     * @return the type of the last message read: {@code PLAYER_MSGTYPE_DATA} or {@code PLAYER_MSGTYPE_SYNCH}, or in
     *     push mode that of a reply where there is nothing else; 0 at once if the client is threaded
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
        return incoming.read(pull);
    }

    /**
     * Asks for data, as the pull mode needs it. {@link #readAll} and the threaded style do that by themselves, so there
     * is nothing left to do.
     */
    public void requestData() {
        calling(connection::devices); // throws if the server has gone
    }

    /**
     * Chooses between {@code PLAYER_DATAMODE_PUSH} (the default) and {@code PLAYER_DATAMODE_PULL}.
     *
     * <p>Behind a socket only a client in pull mode is in lock step, if it has chosen that before its first
     * subscription: a world of ours that has once had a push client keeps pace with real time. In this JVM both modes
     * are in lock step.
     */
    public void requestDataDeliveryMode(int mode) {
        if (mode != PLAYER_DATAMODE_PUSH && mode != PLAYER_DATAMODE_PULL) {
            throw new PlayerException("data delivery mode is " + mode + ", expected 1 (push) or 2 (pull)");
        }
        tell(() -> connection.delivery(mode == PLAYER_DATAMODE_PULL ? Delivery.PULL : Delivery.PUSH));
        pull = mode == PLAYER_DATAMODE_PULL;
    }

    /**
     * Fulfilled when the next frame is complete: all subscribed devices have new data. Our addition to the Player
     * client, for actors; instead of a loop around {@code isDataReady()}. Off actor spaces, asking for it answers the
     * tick.
     */
    public Promise<@Nullable Void> nextData() {
        return incoming.next();
    }

    /**
     * Lets this client notice that its server is connected and silent: when nothing has come from it for half of the
     * limit it is asked for a sign of life, and when none comes in the other half, every call that waits, and every
     * later one, throws {@link PlayerException}. Zero, as at the beginning, is no limit. Commands are still sent, until
     * {@link #close}. Our addition to the Player client, which waits for as long as it takes.
     *
     * <p>By the machine's clock. A server whose time is paused, or whose lock step waits for another client, answers
     * and is not silent; one in this JVM never is.
     */
    public void setSilenceLimit(Duration limit) {
        if (!limit.isZero() && limit.compareTo(Duration.ofMillis(2)) < 0) {
            throw new PlayerException("silence limit is " + limit + ", expected 2 ms or more, or zero for none");
        }
        tell(() -> connection.silenceLimit(limit));
    }

    /**
     * Stops the thread and disconnects; every later call, and every call that waits, throws {@link PlayerException}.
     */
    public void close() {
        incoming.lost("[PlayerClient] this client is closed");
        setNotThreaded();
        connection.close();
    }

    // ---- for devices

    /** Whether a device has news; where it has none, this may be how the program waits. */
    boolean findsNews(Latest<?> asked) {
        if (threaded || space != null) {
            return incoming.poll(asked, subscriptions::everythingSeen, PATIENCE_MILLIS);
        }
        boolean news = incoming.takeNew(asked);
        if (!news) {
            Thread.onSpinWait();
        }
        return news;
    }

    /** Whether the reply to a request has come. */
    boolean findsReply(Latest<?> asked) {
        return incoming.takeReply(asked, PATIENCE_MILLIS);
    }

    void command(DeviceAddress device, DeviceCommand command) {
        tell(() -> connection.command(device, command));
    }

    void request(PlayerDevice device, DeviceRequest request) {
        var address = device.address();
        incoming.requestBegins();
        try {
            tell(() -> connection.request(
                    address,
                    request,
                    reply -> incoming.requestEnds(
                            reply instanceof DeviceReply.Nack ? PLAYER_MSGTYPE_RESP_NACK : PLAYER_MSGTYPE_RESP_ACK,
                            () -> device.receive(request, reply))));
        } catch (PlayerException notSent) {
            incoming.requestFails();
            throw notSent;
        }
    }

    /** Says it once for all robots of this client. */
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
        tell(() -> connection.answered(tick));
    }

    @Override
    PlayerClient client() {
        return this;
    }

    @Override
    PlayerConnection connection() {
        return connection;
    }
}
