package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Delivery;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
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
 * One client of a simulated world.
 *
 * <p><b>Threads.</b> Any thread. Everything that changes is guarded by the simulation's lock: what a client says before
 * its answer is with the simulation when that sees the answer.
 */
final class ClientLine implements PlayerConnection {
    private static final System.Logger LOG = System.getLogger(ClientLine.class.getName());

    private final Simulation simulation;
    private final PortServer server;
    private final DataSink sink;
    private final @Nullable ActorSpace space;
    private final int number;
    private final Set<Offer> subscribed = new LinkedHashSet<>();
    private List<Offer> inFrameOrder = List.of(); // the same
    private final PendingCommands pending = new PendingCommands();
    private final DeviceDesk desk;
    private boolean begun;
    private boolean answers = true;
    private long publishedTick = NO_TICK;
    private long answeredTick = NO_TICK;
    private long turnTick = NO_TICK; // whose frame began a turn of the space that has to end, even if the client leaves
    private boolean asks; // on a space that is never idle: it answers by asking in vain, as a thread does
    private @Nullable String closed;

    ClientLine(Simulation simulation, PortServer server, DataSink sink, @Nullable ActorSpace space) {
        this.simulation = simulation;
        this.server = server;
        this.sink = sink;
        this.space = space;
        this.desk = new DeviceDesk(simulation, this::later);
        this.number = simulation.add(this);
    }

    // ---- for the simulation, under its lock

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

    /** Whether it has subscribed to what it wants and waits for its first data, or has done so. */
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

    // ---- for the simulation, not under its lock

    void deliver(Snapshot now) {
        List<DeviceDataMessage> messages = simulation.quietly(() -> messages(now));
        if (!messages.isEmpty()) {
            sink.frame(new Frame(now.tick(), now.timeMicros() / 1e6, messages));
        }
    }

    private List<DeviceDataMessage> messages(Snapshot now) {
        if (closed != null) {
            return List.of();
        }
        if (space != null && !asks) {
            turnTick = now.tick();
        }
        List<DeviceDataMessage> messages = new ArrayList<>(inFrameOrder.size());
        for (Offer offer : inFrameOrder) {
            if (offer.publishes()) {
                messages.add(DeviceMessages.data(offer, simulation.world().spec(), now));
            }
        }
        return messages;
    }

    /**
     * The answer of a client on a space, which may have closed itself in the same turn. Under the simulation's lock.
     */
    void spaceIsIdle(long tick) {
        answeredTick = Math.max(answeredTick, tick);
        asks = false;
    }

    /** A client ends with the space it lives on, and a turn that was not ended there is not waited for. */
    void endWithSpace() {
        shut("actor space " + space + ", on which this client lived, has been closed", false);
    }

    /** It is not waited for any more, even if it had left in its turn before. */
    void lose(String reason) {
        if (shut(reason, false)) {
            try {
                sink.lost(reason);
            } catch (RuntimeException | Error e) { // the other clients have to learn it all the same
                LOG.log(System.Logger.Level.WARNING, this + " failed when it was disconnected", e);
            }
        }
    }

    // ---- for the client

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
                pending.takeAll(offer).forEach(Runnable::run); // said before it left
                simulation.countDrivers(offer.robot(), -1);
            }
        }
    }

    private void sortSubscribed() {
        inFrameOrder = subscribed.stream().sorted(PortServer.FRAME_ORDER).toList();
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        // nobody waits for a command, and a thousand of them would wake the one who ticks a thousand times
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
        // frames always come whole, and a client answers by waiting
    }

    @Override
    public void replace(ReplaceRule rule) {
        // frames never queue up: no tick goes on before they are answered
    }

    @Override
    public void close() {
        // by another thread it is gone at once: its space may be busy with something that never ends
        boolean inItsTurn = space != null && ActorSpace.current() == space;
        shut("this line to port " + server.port() + " has been closed", inItsTurn);
    }

    /** In one step, so that a tick never sees the client gone and its robot still driving. */
    private boolean shut(String reason, boolean inItsTurn) {
        return simulation.under(() -> {
            if (!inItsTurn) {
                turnTick = NO_TICK;
            }
            if (closed != null) {
                return false;
            }
            List.copyOf(subscribed).forEach(this::drop);
            pending.takeAll().forEach(Runnable::run); // acknowledged before it left
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
            throw new ConnectionClosedException(closed);
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
