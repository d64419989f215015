package io.troupe.sim;

import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.Interfaces;
import io.troupe.sim.PortServer.PortDevice;
import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import java.util.Objects;

/** Converts readings of the world to Player device data. */
final class DeviceConversion {
    private DeviceConversion() {}

    static DeviceDataMessage data(PortDevice device, WorldSpec world, Snapshot now) {
        RobotReading reading = now.robots().get(device.robot());
        DeviceData data = switch (device.type()) {
            case POSITION2D -> position(reading.odometry());
            case SONAR -> new DeviceData.SonarRanges(floats(sonarM(device, world, reading)));
            case RANGER ->
                new DeviceData.RangerRanges(
                        isRing(device.type(), device.ranger())
                                ? Objects.requireNonNull(reading.sonarM())
                                : reading.rangersM().get(device.ranger()));
            case LASER ->
                RangerConversion.scan(
                        world.robots().get(device.robot()).rangers().get(device.ranger()),
                        reading.rangersM().get(device.ranger()),
                        intensities(device, now),
                        now.tick());
            case BLOBFINDER -> blobs(Objects.requireNonNull(reading.blobs()));
            case FIDUCIAL, BUMPER, CAMERA, GRIPPER ->
                FurtherDevices.data(reading.devices().get(device.ranger()));
            case SIMULATION -> throw new IllegalStateException("the simulation device publishes nothing");
        };
        return new DeviceDataMessage(device.address(), now.timeMicros() / 1e6, data);
    }

    /** True if a device is the robot's sonar ring, offered as a ranger. */
    static boolean isRing(Interfaces type, int ranger) {
        return type == Interfaces.RANGER && ranger == DeviceBinding.SONAR_RING;
    }

    /** Intensities of a laser or ranger; empty if it does not measure them. */
    static List<Double> intensities(PortDevice device, Snapshot now) {
        List<List<Double>> all = now.robots().get(device.robot()).intensities();
        return all.isEmpty() || isRing(device.type(), device.ranger()) ? List.of() : all.get(device.ranger());
    }

    /** Ranges of the robot's sonar ring or, without a ring, of the ranger that replaces it. */
    private static List<Double> sonarM(PortDevice device, WorldSpec world, RobotReading reading) {
        return world.robots().get(device.robot()).sonar() == null
                ? reading.rangersM().get(device.ranger())
                : Objects.requireNonNull(reading.sonarM());
    }

    private static DeviceData position(Odometry odometry) {
        Pose pose = odometry.pose();
        return new DeviceData.Position2d(
                pose.x(),
                pose.y(),
                pose.headingRad(),
                odometry.forwardMps(),
                odometry.sidewaysMps(),
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

    private static DeviceData.Blob blob(ColourBlob blob) {
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

    /** Blobs from right to left, in Stage's order. As in Stage, the image size is 0 x 0 when there is no blob. */
    private static DeviceData blobs(BlobImage image) {
        boolean empty = image.blobs().isEmpty();
        return new DeviceData.Blobs(
                empty ? 0 : image.widthPx(),
                empty ? 0 : image.heightPx(),
                empty
                        ? List.of()
                        : image.blobs().reversed().stream()
                                .map(DeviceConversion::blob)
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
