package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.LineClosedException;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.sim.PortServer.Offer;
import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/** One client of a simulated world. What it has subscribed to and answered is guarded by the simulation's lock. */
final class ClientLine implements PlayerConnection {
    private final Simulation simulation;
    private final int port;
    private final List<Offer> offers;
    private final DataSink sink;
    private final @Nullable ActorSpace space;
    private final int number;
    private final Set<Offer> subscribed = new LinkedHashSet<>();
    private long answeredTick = -1;
    private volatile @Nullable String closed;

    ClientLine(Simulation simulation, int port, List<Offer> offers, DataSink sink, @Nullable ActorSpace space) {
        this.simulation = simulation;
        this.port = port;
        this.offers = offers;
        this.sink = sink;
        this.space = space;
        this.number = simulation.add(this);
    }

    // ---- for the simulation

    @Nullable
    ActorSpace space() {
        return space;
    }

    boolean isSubscribed() {
        return !subscribed.isEmpty();
    }

    boolean hasAnswered(long tick) {
        return answeredTick >= tick || closed != null || subscribed.isEmpty();
    }

    void deliver(Snapshot now) {
        var messages = new ArrayList<DataMessage>();
        double timeSeconds = now.timeMicros() / 1e6;
        List<Offer> wanted = new ArrayList<>();
        simulation.changed(() -> offers.stream().filter(subscribed::contains).forEach(wanted::add));
        for (var offer : wanted) {
            DeviceData data = read(offer, now);
            if (data != null) {
                messages.add(new DataMessage(offer.address(), timeSeconds, data));
            }
        }
        if (!messages.isEmpty() && closed == null) {
            sink.frame(new Frame(now.tick(), timeSeconds, messages));
        }
    }

    void lose(String reason) {
        if (closed == null) {
            closed = reason;
            sink.lost(reason);
        }
    }

    private static @Nullable DeviceData read(Offer offer, Snapshot now) {
        if (offer.robot() < 0) {
            return null;
        }
        RobotReading reading = now.robots().get(offer.robot());
        return switch (offer.type()) {
            case POSITION2D -> position(reading.odometry());
            case SONAR ->
                new DeviceData.SonarRanges(Objects.requireNonNull(reading.sonarM()).stream()
                        .map(Double::floatValue)
                        .toList());
            case BLOBFINDER -> blobs(Objects.requireNonNull(reading.blobs()));
            case SIMULATION -> null;
        };
    }

    private static DeviceData position(Odometry odometry) {
        Pose pose = odometry.pose();
        return new DeviceData.Position2d(
                pose.x(),
                pose.y(),
                pose.headingRad(),
                odometry.forwardMps(),
                0,
                odometry.turnRadps(),
                odometry.stalled());
    }

    /** Stage says 0 x 0 when it sees no blob. */
    private static DeviceData blobs(BlobImage image) {
        if (image.blobs().isEmpty()) {
            return new DeviceData.Blobs(0, 0, List.of());
        }
        return new DeviceData.Blobs(
                image.widthPx(),
                image.heightPx(),
                image.blobs().stream()
                        .map(blob -> new DeviceData.Blob(
                                0,
                                blob.colour(),
                                blob.areaPx2(),
                                blob.x(),
                                blob.y(),
                                blob.left(),
                                blob.right(),
                                blob.top(),
                                blob.bottom(),
                                (float) blob.rangeM()))
                        .toList());
    }

    // ---- for the client

    @Override
    public List<DeviceAddress> devices() {
        checkOpen();
        return offers.stream().map(Offer::address).toList();
    }

    @Override
    public String driverName(DeviceAddress device) {
        find(device);
        return "stage";
    }

    @Override
    public void subscribe(DeviceAddress device) {
        Offer offer = find(device);
        simulation.changed(() -> {
            if (subscribed.add(offer) && offer.type() == Interfaces.POSITION2D) {
                simulation.countDrivers(offer.robot(), 1);
            }
        });
    }

    @Override
    public void unsubscribe(DeviceAddress device) {
        Offer offer = find(device);
        simulation.changed(() -> drop(offer));
    }

    private void drop(Offer offer) {
        if (subscribed.remove(offer) && offer.type() == Interfaces.POSITION2D) {
            simulation.countDrivers(offer.robot(), -1);
        }
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        Offer offer = find(device);
        if (offer.type() == Interfaces.POSITION2D && command instanceof DeviceCommand.Velocity velocity) {
            if (velocity.enabled()) {
                simulation.world().command(offer.robot(), velocity.vx(), velocity.va());
            } else {
                simulation.world().stop(offer.robot());
            }
        }
    }

    @Override
    public DeviceReply request(DeviceAddress device, DeviceRequest request) {
        Offer offer = find(device);
        return switch (offer.type()) {
            case POSITION2D -> answerPosition(offer.robot(), request);
            case SONAR -> request instanceof DeviceRequest.Geometry ? sonarGeometry(offer.robot()) : refuse(request);
            case BLOBFINDER, SIMULATION -> refuse(request);
        };
    }

    private DeviceReply answerPosition(int robot, DeviceRequest request) {
        return switch (request) {
            case DeviceRequest.Geometry geometry -> {
                RobotSpec spec = robotSpec(robot);
                Pose origin = spec.origin();
                yield new DeviceReply.Position2dGeometry(
                        origin.x(), origin.y(), origin.headingRad(), spec.lengthM(), spec.widthM());
            }
            case DeviceRequest.ResetOdometry reset -> rebase(robot, Pose.ORIGIN);
            case DeviceRequest.SetOdometry set -> rebase(robot, new Pose(set.px(), set.py(), set.pa()));
            case DeviceRequest.Power power -> refuse(request);
        };
    }

    private DeviceReply rebase(int robot, Pose pose) {
        simulation.world().setOdometry(robot, pose);
        return new DeviceReply.Ack();
    }

    private DeviceReply sonarGeometry(int robot) {
        return new DeviceReply.SonarGeometry(
                Objects.requireNonNull(robotSpec(robot).sonar()).mounts().stream()
                        .map(mount -> new DeviceReply.SonarMount(mount.x(), mount.y(), mount.headingRad()))
                        .toList());
    }

    private static DeviceReply refuse(DeviceRequest request) {
        return new DeviceReply.Nack("the simulator does not offer " + request + " for this device");
    }

    @Override
    public void answered(long tick) {
        simulation.changed(() -> answeredTick = Math.max(answeredTick, tick));
    }

    @Override
    public void close() {
        if (closed == null) {
            closed = "this line to port " + port + " has been closed";
            simulation.changed(() -> List.copyOf(subscribed).forEach(this::drop));
            simulation.remove(this);
        }
    }

    private RobotSpec robotSpec(int robot) {
        return simulation.world().spec().robots().get(robot);
    }

    private Offer find(DeviceAddress device) {
        checkOpen();
        return offers.stream()
                .filter(each -> each.address().equals(device))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException("port " + port + " has no device " + device));
    }

    private void checkOpen() {
        String reason = closed;
        if (reason != null) {
            throw new LineClosedException(reason);
        }
    }

    @Override
    public String toString() {
        String devices = subscribed.stream()
                .map(each -> each.type().playerName() + ":" + each.address().index())
                .collect(Collectors.joining(" "));
        return "client " + number + " on port " + port + " (" + devices
                + (space == null ? ")" : "; on actor space " + space + ")");
    }
}
