package io.troupe.sim;

import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.Interfaces;
import io.troupe.sim.PortServer.Offer;
import io.troupe.sim.device.Blob;
import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.scenario.DeviceBinding;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RangeSensorSpec;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.SonarSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.List;
import java.util.Objects;

/** Readings of the world in the words of Player. */
final class DeviceMessages {
    private DeviceMessages() {}

    static DeviceDataMessage data(Offer offer, WorldSpec world, Snapshot now) {
        RobotReading reading = now.robots().get(offer.robot());
        DeviceData data = switch (offer.type()) {
            case POSITION2D -> position(reading.odometry());
            case SONAR -> new DeviceData.SonarRanges(floats(sonarM(offer, world, reading)));
            case RANGER ->
                new DeviceData.RangerRanges(
                        isRing(offer.type(), offer.ranger())
                                ? Objects.requireNonNull(reading.sonarM())
                                : reading.rangersM().get(offer.ranger()));
            case LASER ->
                RangerMessages.scan(
                        world.robots().get(offer.robot()).rangers().get(offer.ranger()),
                        reading.rangersM().get(offer.ranger()),
                        now.tick());
            case BLOBFINDER -> blobs(Objects.requireNonNull(reading.blobs()));
            case SIMULATION -> throw new IllegalStateException("the simulation device publishes nothing");
        };
        return new DeviceDataMessage(offer.address(), now.timeMicros() / 1e6, data);
    }

    /** Whether a device is the robot's sonar ring, offered as a ranger. */
    static boolean isRing(Interfaces type, int ranger) {
        return type == Interfaces.RANGER && ranger == DeviceBinding.SONAR_RING;
    }

    /** Of the robot's ring, or where it has none of the ranger that stands for one. */
    private static List<Double> sonarM(Offer offer, WorldSpec world, RobotReading reading) {
        return world.robots().get(offer.robot()).sonar() == null
                ? reading.rangersM().get(offer.ranger())
                : Objects.requireNonNull(reading.sonarM());
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

    private static List<Float> floats(List<Double> rangesM) {
        var converted = new Float[rangesM.size()];
        for (int i = 0; i < converted.length; i++) {
            converted[i] = rangesM.get(i).floatValue();
        }
        return List.of(converted);
    }

    private static DeviceData.Blob blob(Blob blob) {
        return new DeviceData.Blob(
                0,
                blob.colour(),
                blob.areaPx2(),
                blob.x(),
                blob.y(),
                blob.left(),
                blob.right(),
                blob.top(),
                blob.bottom(),
                (float) blob.rangeM());
    }

    /** From right to left, as Stage lists them. The image is 0 x 0 when it shows no blob, as Stage's is. */
    private static DeviceData blobs(BlobImage image) {
        boolean empty = image.blobs().isEmpty();
        return new DeviceData.Blobs(
                empty ? 0 : image.widthPx(),
                empty ? 0 : image.heightPx(),
                empty
                        ? List.of()
                        : image.blobs().reversed().stream()
                                .map(DeviceMessages::blob)
                                .toList());
    }

    static DeviceReply positionGeometry(RobotSpec robot) {
        Pose origin = robot.origin();
        return new DeviceReply.Position2dGeometry(
                origin.x(), origin.y(), origin.headingRad(), robot.lengthM(), robot.widthM());
    }

    static DeviceReply sonarGeometry(RobotSpec robot, int ranger) {
        SonarSpec ring = robot.sonar();
        List<Pose> mounts = ring != null
                ? ring.mounts()
                : robot.rangers().get(ranger).sensors().stream()
                        .map(RangeSensorSpec::mount)
                        .toList();
        return new DeviceReply.SonarGeometry(mounts.stream()
                .map(mount -> new DeviceReply.SonarMount(mount.x(), mount.y(), mount.headingRad()))
                .toList());
    }
}
