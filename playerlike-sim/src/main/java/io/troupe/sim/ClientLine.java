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
import io.troupe.sim.scenario.Pose;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * One client of a simulated world.
 *
 * <p><b>Threads.</b> Any thread. Everything that changes is guarded by the simulation's lock: what a client says before its answer is with the simulation
 * when that sees the answer.
 */
final class ClientLine implements PlayerConnection {
    private final Simulation simulation;
    private final int port;
    private final List<Offer> offers;
    private final DataSink sink;
    private final @Nullable ActorSpace space;
    private final int number;
    private final Set<Offer> subscribed = new LinkedHashSet<>();
    private final PendingCommands pending = new PendingCommands();
    private boolean begun;
    private boolean neverAnswers;
    private long publishedTick = NO_TICK;
    private long answeredTick = NO_TICK;
    private @Nullable String closed;

    ClientLine(Simulation simulation, int port, List<Offer> offers, DataSink sink, @Nullable ActorSpace space) {
        this.simulation = simulation;
        this.port = port;
        this.offers = offers;
        this.sink = sink;
        this.space = space;
        this.number = simulation.add(this);
    }

    // ---- for the simulation, under its lock

    @Nullable
    ActorSpace space() {
        return space;
    }

    boolean isSubscribed() {
        return closed == null && subscribed.stream().anyMatch(Offer::publishes);
    }

    /** Whether it has subscribed to what it wants and waits for its first data, or has done so. */
    boolean hasBegun() {
        return begun && isSubscribed();
    }

    boolean hasAnswered(long tick) {
        return neverAnswers || answeredTick >= tick || !isSubscribed();
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
        List<DataMessage> messages = simulation.under(() -> closed != null
                ? List.of()
                : offers.stream()
                        .filter(offer -> offer.publishes() && subscribed.contains(offer))
                        .map(offer -> DeviceMessages.data(offer, now))
                        .toList());
        if (!messages.isEmpty()) {
            sink.frame(new Frame(now.tick(), now.timeMicros() / 1e6, messages));
        }
    }

    /** The answer of a client on a space, which may have closed itself in the same turn. */
    void spaceIsIdle(long tick) {
        simulation.under(() -> answeredTick = Math.max(answeredTick, tick));
    }

    void lose(String reason) {
        if (shut(reason)) {
            sink.lost(reason);
        }
    }

    // ---- for the client

    @Override
    public List<DeviceAddress> devices() {
        return simulation.under(() -> {
            checkOpen();
            return offers.stream().map(Offer::address).toList();
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
            if (subscribed.add(offer) && offer.type() == Interfaces.POSITION2D) {
                simulation.countDrivers(offer.robot(), 1);
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
        if (subscribed.remove(offer) && offer.type() == Interfaces.POSITION2D) {
            pending.takeAll(offer.robot()).forEach(Runnable::run); // said before it left
            simulation.countDrivers(offer.robot(), -1);
        }
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        simulation.under(() -> {
            Offer offer = find(device);
            if (offer.type() != Interfaces.POSITION2D) {
                throw new IllegalArgumentException(offer + " takes no commands");
            }
            if (!(command instanceof DeviceCommand.Velocity velocity)) {
                throw new IllegalArgumentException(offer + " does not understand " + command);
            }
            if (!Double.isFinite(velocity.vx()) || !Double.isFinite(velocity.va())) {
                throw new IllegalArgumentException(offer + " was told " + velocity + ", expected finite numbers");
            }
            World world = simulation.world();
            int robot = offer.robot();
            later(
                    robot,
                    PendingCommands.Kind.SPEED,
                    velocity.enabled()
                            ? () -> world.command(robot, velocity.vx(), velocity.va())
                            : () -> world.stop(robot));
            return offer;
        });
    }

    private void later(int robot, PendingCommands.Kind kind, Runnable command) {
        boolean late = publishedTick != NO_TICK && answeredTick >= publishedTick;
        pending.add(robot, kind, command, late);
    }

    @Override
    public DeviceReply request(DeviceAddress device, DeviceRequest request) {
        return simulation.under(() -> {
            Offer offer = find(device);
            return switch (request) {
                case DeviceRequest.Geometry geometry
                when offer.type() == Interfaces.POSITION2D ->
                    DeviceMessages.positionGeometry(
                            simulation.world().spec().robots().get(offer.robot()));
                case DeviceRequest.Geometry geometry
                when offer.type() == Interfaces.SONAR ->
                    DeviceMessages.sonarGeometry(
                            simulation.world().spec().robots().get(offer.robot()));
                case DeviceRequest.ResetOdometry reset
                when offer.type() == Interfaces.POSITION2D -> rebase(offer.robot(), Pose.ORIGIN);
                case DeviceRequest.SetOdometry set
                when offer.type() == Interfaces.POSITION2D ->
                    rebase(offer.robot(), new Pose(set.px(), set.py(), set.pa()));
                // simulated motors and sonars are always on
                case DeviceRequest.Power power when power.on() && offer.robot() >= 0 -> new DeviceReply.Ack();
                default -> new DeviceReply.Nack("the simulator does not offer that for this device");
            };
        });
    }

    private DeviceReply rebase(int robot, Pose pose) {
        if (!Double.isFinite(pose.x()) || !Double.isFinite(pose.y()) || !Double.isFinite(pose.headingRad())) {
            return new DeviceReply.Nack("odometry cannot be " + pose + ", expected finite numbers");
        }
        World world = simulation.world();
        later(robot, PendingCommands.Kind.ODOMETRY, () -> world.setOdometry(robot, pose));
        return new DeviceReply.Ack();
    }

    @Override
    public void answered(long tick) {
        simulation.under(() -> {
            checkOpen();
            begun = true;
            answeredTick = Math.max(answeredTick, tick);
            return tick;
        });
    }

    @Override
    public void neverAnswers() {
        simulation.under(() -> {
            checkOpen();
            begun = true;
            neverAnswers = true;
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
        shut("this line to port " + port + " has been closed");
    }

    /** In one step, so that a tick never sees the client gone and its robot still driving. */
    private boolean shut(String reason) {
        return simulation.under(() -> {
            if (closed != null) {
                return false;
            }
            List.copyOf(subscribed).forEach(this::drop);
            closed = reason;
            simulation.remove(this);
            return true;
        });
    }

    private Offer find(DeviceAddress device) {
        checkOpen();
        return offers.stream()
                .filter(each -> each.address().equals(device))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException("port " + port + " has no device " + device));
    }

    private void checkOpen() {
        if (closed != null) {
            throw new LineClosedException(closed);
        }
    }

    @Override
    public String toString() {
        String devices = subscribed.stream().map(Offer::toString).collect(Collectors.joining(" "));
        return "client " + number + " on port " + port + " (" + devices
                + (space == null ? ")" : "; on actor space " + space + ")");
    }
}
