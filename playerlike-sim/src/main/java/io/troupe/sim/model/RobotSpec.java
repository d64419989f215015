package io.troupe.sim.model;

import io.troupe.common.text.SourcePosition;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A differential-drive robot: the Stage entity {@code position} with everything attached to it.
 *
 * @param name its name in the world file, unique in the world
 * @param pose start pose in the world's frame
 * @param colour {@code 0x00RRGGBB}
 * @param lengthM x extent of the body
 * @param widthM y extent of the body
 * @param origin of the body's centre relative to the centre of rotation (Stage's {@code origin})
 * @param startOdometry odometry pose at the start: the zero pose in the classic dialect
 * @param sonar null if it has none
 * @param blobfinder null if it has none
 * @param rangers its lasers and rangers, in the order of the file
 * @param blocksRangers it stops the rays of other robots
 * @param visible the blobfinders of other robots see it
 * @param blocksBodies false if it passes through all bodies
 * @param drive start speed, limits and kind of odometry
 * @param cargo the things that it carries
 * @param traits what only some devices of others notice of its body
 * @param devices its further devices, in the order of the file
 */
public record RobotSpec(
        String name,
        Pose pose,
        Shape shape,
        int colour,
        double lengthM,
        double widthM,
        double massKg,
        Pose origin,
        Pose startOdometry,
        @Nullable SonarSpec sonar,
        @Nullable BlobfinderSpec blobfinder,
        List<RangerSpec> rangers,
        boolean blocksRangers,
        boolean visible,
        boolean blocksBodies,
        DriveSpec drive,
        List<CargoSpec> cargo,
        Traits traits,
        List<DeviceSpec> devices,
        SourcePosition where) {
    public RobotSpec {
        rangers = List.copyOf(rangers);
        cargo = List.copyOf(cargo);
        devices = List.copyOf(devices);
    }

    /** Creates a robot that blocks bodies, drives without limits and carries nothing. */
    public RobotSpec(
            String name,
            Pose pose,
            Shape shape,
            int colour,
            double lengthM,
            double widthM,
            double massKg,
            Pose origin,
            Pose startOdometry,
            @Nullable SonarSpec sonar,
            @Nullable BlobfinderSpec blobfinder,
            List<RangerSpec> rangers,
            boolean blocksRangers,
            boolean visible,
            SourcePosition where) {
        this(
                name,
                pose,
                shape,
                colour,
                lengthM,
                widthM,
                massKg,
                origin,
                startOdometry,
                sonar,
                blobfinder,
                rangers,
                blocksRangers,
                visible,
                true,
                DriveSpec.STANDARD,
                List.of(),
                Traits.PLAIN,
                List.of(),
                where);
    }

    /** The shape that collides with other bodies: the robot's body and its blocking cargo. */
    public Shape collisionShape() {
        Shape whole = shape;
        for (CargoSpec piece : cargo) {
            whole = piece.blocksBodies() ? whole.with(piece.shape()) : whole;
        }
        return whole;
    }

    /** Bounds of the odometry error; {@link OdometryError#NONE} unless the file specifies it. */
    public OdometryError odometryError() {
        return switch (drive.localization()) {
            case DriveSpec.Localization.Gps gps -> OdometryError.NONE;
            case DriveSpec.Localization.DeadReckoning counted ->
                new OdometryError(counted.forward(), counted.sideways(), counted.turn());
        };
    }

    /** A copy with odometry that sums up the motion of the wheels, with the given error. */
    public RobotSpec withOdometryError(OdometryError error) {
        var counted = new DriveSpec.Localization.DeadReckoning(error.x(), error.y(), error.heading());
        return with(rangers, drive.withLocalization(counted));
    }

    /** A copy with the given lasers and rangers. */
    public RobotSpec withRangers(List<RangerSpec> others) {
        return with(others, drive);
    }

    /** A copy that no device of another robot senses. */
    public RobotSpec unseen() {
        List<CargoSpec> unseenCargo = cargo.stream()
                .map(piece -> new CargoSpec(piece.shape(), piece.colour(), piece.blocksBodies(), false, false))
                .toList();
        return new RobotSpec(
                name,
                pose,
                shape,
                colour,
                lengthM,
                widthM,
                massKg,
                origin,
                startOdometry,
                sonar,
                blobfinder,
                rangers,
                false,
                false,
                false,
                drive,
                unseenCargo,
                Traits.PLAIN,
                devices,
                where);
    }

    private RobotSpec with(List<RangerSpec> otherRangers, DriveSpec otherDrive) {
        return new RobotSpec(
                name,
                pose,
                shape,
                colour,
                lengthM,
                widthM,
                massKg,
                origin,
                startOdometry,
                sonar,
                blobfinder,
                otherRangers,
                blocksRangers,
                visible,
                blocksBodies,
                otherDrive,
                cargo,
                traits,
                devices,
                where);
    }
}
