package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Delivery;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.ReplaceRule;
import io.troupe.sim.PortServer.PortDevice;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * A client's connection to a simulated world.
 *
 * <p><b>Threads.</b> Any thread. All mutable state is guarded by the simulation's lock, so a command that a client
 * sends before its answer has arrived when the simulation sees that answer.
 */
final class ClientConnection implements PlayerConnection {
    private static final System.Logger LOG = System.getLogger(Simulation.class.getName());

    private final Simulation simulation;
    private final PortServer server;
    private final DataSink sink;
    private final @Nullable ActorSpace space;
    private final int number;
    private final Set<PortDevice> subscribed = new LinkedHashSet<>();
    private List<PortDevice> inFrameOrder = List.of(); // the same devices, sorted
    private final ClientCommands pending = new ClientCommands();
    private final DeviceRequestHandler requestHandler;
    private boolean started;
    private boolean answers = true;
    private long publishedTick = NO_TICK;
    private long answeredTick = NO_TICK;
    private long turnTick = NO_TICK; // tick whose turn must complete even if the client disconnects
    private boolean polls; // never-idle space: an unsuccessful poll counts as the answer
    private @Nullable String closed;

    ClientConnection(Simulation simulation, PortServer server, DataSink sink, @Nullable ActorSpace space) {
        this.simulation = simulation;
        this.server = server;
        this.sink = sink;
        this.space = space;
        this.requestHandler = new DeviceRequestHandler(simulation, this::enqueue);
        this.number = simulation.add(this);
    }

    // ---- called by the simulation, under its lock

    @Nullable
    ActorSpace space() {
        return space;
    }

    boolean isSubscribed() {
        if (closed == null) {
            for (PortDevice device : inFrameOrder) {
                if (device.publishes()) {
                    return true;
                }
            }
        }
        return false;
    }

    boolean isFreeRunning() {
        return !isAnswering() && isSubscribed();
    }

    /** True once the client waits for data and is subscribed to a device that publishes. */
    boolean hasStarted() {
        return started && isSubscribed();
    }

    private boolean isAnswering() {
        return answers && simulation.isLockStep();
    }

    boolean hasAnswered(long tick) {
        return !isAnswering() || answeredTick >= tick || turnTick != tick && !isSubscribed();
    }

    void tickBegins(long tick) {
        publishedTick = tick;
        pending.tickBegins();
    }

    List<Runnable> takeCommands() {
        return pending.take();
    }

    // ---- called by the simulation, without its lock

    void deliver(Snapshot now) {
        List<DeviceDataMessage> messages = simulation.withLockNoNotify(() -> messages(now));
        if (!messages.isEmpty()) {
            sink.frame(new Frame(now.tick(), now.timeMicros() / 1e6, messages));
        }
    }

    private List<DeviceDataMessage> messages(Snapshot now) {
        if (closed != null) {
            return List.of();
        }
        if (space != null && !polls) {
            turnTick = now.tick();
        }
        List<DeviceDataMessage> messages = new ArrayList<>(inFrameOrder.size());
        for (PortDevice device : inFrameOrder) {
            if (device.publishes()) {
                messages.add(DeviceConversion.data(device, simulation.world().spec(), now));
                if (requestHandler.wantsIntensities(device)) {
                    List<Double> intensities = DeviceConversion.intensities(device, now);
                    if (!intensities.isEmpty()) {
                        var data = new DeviceData.RangerIntensities(intensities);
                        messages.add(new DeviceDataMessage(device.address(), now.timeMicros() / 1e6, data));
                    }
                }
            }
        }
        return messages;
    }

    /**
     * Records the answer of a client on a space; the client may have closed itself in the same turn. Called under the
     * simulation's lock.
     */
    void spaceIsIdle(long tick) {
        answeredTick = Math.max(answeredTick, tick);
        polls = false;
    }

    /**
     * Disconnects the client because its actor space has been closed. A turn that did not complete there is not waited
     * for.
     */
    void spaceClosed() {
        close("actor space " + space + ", on which this client lived, has been closed", false);
    }

    /** Disconnects the client. Ticks no longer wait for it, even if it had closed itself during its turn. */
    void disconnect(String reason) {
        if (close(reason, false)) {
            try {
                sink.lost(reason);
            } catch (RuntimeException | Error e) { // the other clients must still be disconnected
                LOG.log(System.Logger.Level.WARNING, this + " failed when it was disconnected", e);
            }
        }
    }

    // ---- called by the client

    @Override
    public List<DeviceAddress> devices() {
        return simulation.withLock(() -> {
            checkOpen();
            return server.addresses();
        });
    }

    @Override
    public String driverName(DeviceAddress address) {
        return simulation.withLock(() -> {
            find(address);
            return "stage";
        });
    }

    @Override
    public void subscribe(DeviceAddress address) {
        simulation.withLock(() -> {
            PortDevice device = find(address);
            if (subscribed.add(device)) {
                sortSubscribed();
                if (device.type() == Interfaces.POSITION2D) {
                    simulation.drivers().joined(device.robot());
                }
            }
            return device;
        });
    }

    @Override
    public void unsubscribe(DeviceAddress address) {
        simulation.withLock(() -> {
            PortDevice device = find(address);
            drop(device);
            return device;
        });
    }

    private void drop(PortDevice device) {
        if (subscribed.remove(device)) {
            sortSubscribed();
            if (device.type() == Interfaces.POSITION2D) {
                pending.takeAll(device).forEach(Runnable::run); // sent before it unsubscribed
                simulation.drivers().left(device.robot());
            }
        }
    }

    private void sortSubscribed() {
        inFrameOrder = subscribed.stream().sorted(PortServer.FRAME_ORDER).toList();
    }

    @Override
    public void command(DeviceAddress address, DeviceCommand command) {
        // no tick waits for a command, and a thousand commands would wake the ticking thread a thousand times
        simulation.withLockNoNotify(() -> {
            PortDevice device = find(address);
            requestHandler.command(device, command);
            return device;
        });
    }

    private void enqueue(PortDevice device, ClientCommands.Kind kind, Runnable action) {
        boolean late = isAnswering() && publishedTick != NO_TICK && answeredTick >= publishedTick;
        pending.add(device, kind, action, late);
    }

    @Override
    public DeviceReply request(DeviceAddress address, DeviceRequest request) {
        return simulation.withLock(() -> requestHandler.request(find(address), request));
    }

    @Override
    public void answered(long tick) {
        simulation.withLock(() -> {
            checkOpen();
            started = true;
            polls |= tick != NO_TICK;
            answeredTick = Math.max(answeredTick, tick);
            return tick;
        });
    }

    @Override
    public void answers(boolean whether) {
        simulation.withLock(() -> {
            checkOpen();
            started |= !whether;
            answers = whether;
            return true;
        });
    }

    @Override
    public boolean isWaitedFor() {
        return simulation.withLockNoNotify(this::isAnswering);
    }

    @Override
    public void delivery(Delivery mode) {
        // frames are always delivered whole, and a client answers by waiting for the next one
    }

    @Override
    public void replace(ReplaceRule rule) {
        // frames never queue up: no tick goes on before they are answered
    }

    @Override
    public void close() {
        // when another thread closes it, the client is removed at once: its space may run a turn that never ends
        boolean inItsTurn = space != null && ActorSpace.current() == space;
        close("the connection to port " + server.port() + " is closed", inItsTurn);
    }

    /**
     * Closes the connection in one step under the lock, so that a tick never sees the client gone and its robot still
     * driving.
     */
    private boolean close(String reason, boolean inItsTurn) {
        return simulation.withLock(() -> {
            if (!inItsTurn) {
                turnTick = NO_TICK;
            }
            if (closed != null) {
                return false;
            }
            List.copyOf(subscribed).forEach(this::drop);
            pending.takeAll().forEach(Runnable::run); // these commands were acknowledged before the client left
            closed = reason;
            simulation.endPauseOf(requestHandler);
            simulation.remove(this);
            return true;
        });
    }

    private PortDevice find(DeviceAddress address) {
        checkOpen();
        PortDevice device = server.find(address);
        if (device == null) {
            throw new IllegalArgumentException("port " + server.port() + " has no device " + address);
        }
        return device;
    }

    private void checkOpen() {
        if (closed != null) {
            throw new ConnectionClosedException(closed);
        }
    }

    @Override
    public String toString() {
        String devices = closed != null
                ? "it has left"
                : subscribed.stream().map(PortDevice::toString).collect(Collectors.joining(" "));
        return "client " + number + " on port " + server.port() + " (" + devices
                + (space == null ? ")" : "; on actor space " + space + ")");
    }
}
