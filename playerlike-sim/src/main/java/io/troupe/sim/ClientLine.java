package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Delivery;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.LineClosedException;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.ReplaceRule;
import io.troupe.sim.PortServer.Offer;
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
final class ClientLine implements PlayerConnection {
    private static final System.Logger LOG = System.getLogger(ClientLine.class.getName());

    private final Simulation simulation;
    private final PortServer server;
    private final DataSink sink;
    private final @Nullable ActorSpace space;
    private final int number;
    private final Set<Offer> subscribed = new LinkedHashSet<>();
    private List<Offer> inFrameOrder = List.of(); // the same devices, sorted
    private final PendingCommands pending = new PendingCommands();
    private final DeviceDesk desk;
    private boolean begun;
    private boolean answers = true;
    private long publishedTick = NO_TICK;
    private long answeredTick = NO_TICK;
    private long turnTick = NO_TICK; // tick whose turn must complete even if the client disconnects
    private boolean asks; // never-idle space: an unsuccessful poll counts as the answer
    private @Nullable String closed;

    ClientLine(Simulation simulation, PortServer server, DataSink sink, @Nullable ActorSpace space) {
        this.simulation = simulation;
        this.server = server;
        this.sink = sink;
        this.space = space;
        this.desk = new DeviceDesk(simulation, this::later);
        this.number = simulation.add(this);
    }

    // ---- called by the simulation, under its lock

    @Nullable
    ActorSpace space() {
        return space;
    }

    boolean isSubscribed() {
        if (closed == null) {
            for (Offer offer : inFrameOrder) {
                if (offer.publishes()) {
                    return true;
                }
            }
        }
        return false;
    }

    boolean isFreeRunning() {
        return !isWaitedFor() && isSubscribed();
    }

    /** True once the client waits for data and is subscribed to a device that publishes. */
    boolean hasBegun() {
        return begun && isSubscribed();
    }

    private boolean isWaitedFor() {
        return answers && simulation.isLockStep();
    }

    boolean hasAnswered(long tick) {
        return !isWaitedFor() || answeredTick >= tick || turnTick != tick && !isSubscribed();
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
        List<DataMessage> messages = simulation.quietly(() -> messages(now));
        if (!messages.isEmpty()) {
            sink.frame(new Frame(now.tick(), now.timeMicros() / 1e6, messages));
        }
    }

    private List<DataMessage> messages(Snapshot now) {
        if (closed != null) {
            return List.of();
        }
        if (space != null && !asks) {
            turnTick = now.tick();
        }
        List<DataMessage> messages = new ArrayList<>(inFrameOrder.size());
        for (Offer offer : inFrameOrder) {
            if (offer.publishes()) {
                messages.add(DeviceMessages.data(offer, simulation.world().spec(), now));
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
        asks = false;
    }

    /**
     * Disconnects the client because its actor space has been closed. A turn that did not complete there is not waited
     * for.
     */
    void endWithSpace() {
        shut("actor space " + space + ", on which this client lived, has been closed", false);
    }

    /** Disconnects the client. Ticks no longer wait for it, even if it had closed itself during its turn. */
    void lose(String reason) {
        if (shut(reason, false)) {
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
        return simulation.under(() -> {
            checkOpen();
            return server.addresses();
        });
    }

    @Override
    public String driverName(DeviceAddress device) {
        return simulation.under(() -> {
            find(device);
            return "stage";
        });
    }

    @Override
    public void subscribe(DeviceAddress device) {
        simulation.under(() -> {
            Offer offer = find(device);
            if (subscribed.add(offer)) {
                sortSubscribed();
                if (offer.type() == Interfaces.POSITION2D) {
                    simulation.countDrivers(offer.robot(), 1);
                }
            }
            return offer;
        });
    }

    @Override
    public void unsubscribe(DeviceAddress device) {
        simulation.under(() -> {
            Offer offer = find(device);
            drop(offer);
            return offer;
        });
    }

    private void drop(Offer offer) {
        if (subscribed.remove(offer)) {
            sortSubscribed();
            if (offer.type() == Interfaces.POSITION2D) {
                pending.takeAll(offer).forEach(Runnable::run); // sent before it unsubscribed
                simulation.countDrivers(offer.robot(), -1);
            }
        }
    }

    private void sortSubscribed() {
        inFrameOrder = subscribed.stream().sorted(PortServer.FRAME_ORDER).toList();
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        // no tick waits for a command, and a thousand commands would wake the ticking thread a thousand times
        simulation.quietly(() -> {
            Offer offer = find(device);
            desk.command(offer, command);
            return offer;
        });
    }

    private void later(Offer offer, PendingCommands.Kind kind, Runnable action) {
        boolean late = isWaitedFor() && publishedTick != NO_TICK && answeredTick >= publishedTick;
        pending.add(offer, kind, action, late);
    }

    @Override
    public DeviceReply request(DeviceAddress device, DeviceRequest request) {
        return simulation.under(() -> desk.request(find(device), request));
    }

    @Override
    public void answered(long tick) {
        simulation.under(() -> {
            checkOpen();
            begun = true;
            asks |= tick != NO_TICK;
            answeredTick = Math.max(answeredTick, tick);
            return tick;
        });
    }

    @Override
    public void answers(boolean whether) {
        simulation.under(() -> {
            checkOpen();
            begun |= !whether;
            answers = whether;
            return true;
        });
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
        shut("this line to port " + server.port() + " has been closed", inItsTurn);
    }

    /**
     * Closes the connection in one step under the lock, so that a tick never sees the client gone and its robot still
     * driving.
     */
    private boolean shut(String reason, boolean inItsTurn) {
        return simulation.under(() -> {
            if (!inItsTurn) {
                turnTick = NO_TICK;
            }
            if (closed != null) {
                return false;
            }
            List.copyOf(subscribed).forEach(this::drop);
            pending.takeAll().forEach(Runnable::run); // these commands were acknowledged before the client left
            closed = reason;
            simulation.endPauseOf(desk);
            simulation.remove(this);
            return true;
        });
    }

    private Offer find(DeviceAddress device) {
        checkOpen();
        Offer offer = server.find(device);
        if (offer == null) {
            throw new IllegalArgumentException("port " + server.port() + " has no device " + device);
        }
        return offer;
    }

    private void checkOpen() {
        if (closed != null) {
            throw new LineClosedException(closed);
        }
    }

    @Override
    public String toString() {
        String devices = closed != null
                ? "it has left"
                : subscribed.stream().map(Offer::toString).collect(Collectors.joining(" "));
        return "client " + number + " on port " + server.port() + " (" + devices
                + (space == null ? ")" : "; on actor space " + space + ")");
    }
}
