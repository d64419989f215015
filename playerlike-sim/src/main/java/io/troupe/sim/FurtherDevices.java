package io.troupe.sim;

import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Octets;
import io.troupe.player.wire.Pose3d;
import io.troupe.player.wire.Size3d;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;

/**
 * Converts the readings of the devices of {@link RobotSpec#devices} to Player data, and answers requests to them.
 *
 * <p><b>Source.</b> What Stage acknowledges and refuses. It refuses the field of view of a finder and the request for
 * an image, which are answered here.
 */
final class FurtherDevices {
    private static final DeviceReply NOT_OFFERED =
            new DeviceReply.Nack("the simulator does not offer that for this device");
    private static final Pose3d NO_UNCERTAINTY = Pose3d.flat(0, 0, 0);

    /** Bits of the beams, as Stage sends them. */
    private static final int INNER_BEAM = 4;

    private static final int OUTER_BEAM = 8;

    private FurtherDevices() {}

    private static DeviceReply geometry(DeviceSpec.Gripper gripper) {
        double innerLengthM = gripper.paddleLength() * gripper.lengthM();
        double innerWidthM = gripper.widthM() * (1 - 2 * gripper.paddleWidth());
        return new DeviceReply.GripperGeometry(
                flat(gripper.mount()),
                new Size3d(gripper.widthM(), gripper.lengthM(), gripper.heightM()),
                new Size3d(innerWidthM, innerLengthM, gripper.heightM()),
                2,
                0);
    }

    static DeviceData data(DeviceReading reading) {
        return switch (reading) {
            case DeviceReading.Fiducials(var seen) ->
                new DeviceData.Fiducials(
                        seen.stream().map(FurtherDevices::fiducial).toList());
            case DeviceReading.Picture picture -> image(picture);
            case DeviceReading.Grip(var paddles, boolean outer, boolean inner, boolean holds) ->
                new DeviceData.GripperState(
                        switch (paddles) {
                            case OPEN -> DeviceData.GripperState.OPEN;
                            case CLOSED -> DeviceData.GripperState.CLOSED;
                            case OPENING, CLOSING -> DeviceData.GripperState.MOVING;
                        },
                        (inner ? INNER_BEAM : 0) | (outer ? OUTER_BEAM : 0),
                        0);
            case DeviceReading.Pressed(var bumpers) ->
                new DeviceData.BumperStates(bumpers.stream()
                        .map(pressed -> (byte) (pressed ? 1 : 0))
                        .toList());
            case DeviceReading.Unknown unknown ->
                throw new IllegalArgumentException("the reading of a simulated device is not known");
        };
    }

    private static DeviceData.CameraImage image(DeviceReading.Picture picture) {
        return new DeviceData.CameraImage(
                picture.columns().size(),
                picture.heightPx(),
                24,
                DeviceData.CameraImage.RGB888,
                1,
                DeviceData.CameraImage.RAW,
                Octets.of(picture.rgb()));
    }

    private static DeviceData.Fiducial fiducial(DeviceReading.Fiducial marker) {
        return new DeviceData.Fiducial(
                marker.id(), Pose3d.flat(marker.x(), marker.y(), marker.headingRad()), NO_UNCERTAINTY);
    }

    /** @param newest the newest reading of the device */
    static DeviceReply request(RobotSpec robot, DeviceSpec device, DeviceReading newest, DeviceRequest request) {
        return switch (device) {
            case DeviceSpec.FiducialFinder finder -> ofFinder(robot, finder, request);
            case DeviceSpec.Gripper gripper ->
                request instanceof DeviceRequest.Geometry ? geometry(gripper) : NOT_OFFERED;
            case DeviceSpec.Camera camera ->
                request instanceof DeviceRequest.GetImage && newest instanceof DeviceReading.Picture picture
                        ? new DeviceReply.Image(image(picture))
                        : NOT_OFFERED;
            case DeviceSpec.Bumpers bumpers ->
                request instanceof DeviceRequest.Geometry
                        ? new DeviceReply.BumperGeometry(bumpers.parts().stream()
                                .map(part -> new DeviceReply.Bumper(flat(part.mount()), (float) part.lengthM(), 0))
                                .toList())
                        : NOT_OFFERED;
        };
    }

    private static DeviceReply ofFinder(RobotSpec robot, DeviceSpec.FiducialFinder finder, DeviceRequest request) {
        var view = new DeviceReply.FieldOfView(
                (float) finder.minRangeM(), (float) finder.maxRangeM(), (float) finder.fovRad());
        int own = robot.traits().fiducial();
        return switch (request) {
            case DeviceRequest.Geometry geometry ->
                new DeviceReply.FiducialGeometry(
                        flat(finder.mount()), new Size3d(finder.widthM(), finder.lengthM(), 0), 0, 0);
            case DeviceRequest.GetFieldOfView get -> view;
            case DeviceRequest.SetFieldOfView(float least, float most, float angle) ->
                new DeviceReply.FieldOfView(least, most, angle).equals(view)
                        ? view
                        : new DeviceReply.Nack("the field of view of a simulated finder is that of its world file");
            case DeviceRequest.GetMarker get -> new DeviceReply.Marker(own);
            case DeviceRequest.SetMarker(int id) ->
                id == own
                        ? new DeviceReply.Marker(own)
                        : new DeviceReply.Nack("the marker of robot '" + robot.name() + "' is " + own
                                + ", that of its world file, and cannot be set to " + Integer.toUnsignedString(id));
            default -> NOT_OFFERED;
        };
    }

    private static Pose3d flat(Pose pose) {
        return Pose3d.flat(pose.x(), pose.y(), pose.headingRad());
    }
}
