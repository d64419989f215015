package io.troupe.sim.scenario;

import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A differential-drive robot: the Stage entity {@code position} with what hangs on it.
 *
 * @param name the world file's name of it, unique in the world
 * @param pose start pose in the world's frame
 * @param colour {@code 0x00RRGGBB}
 * @param lengthM x extent of the body
 * @param widthM y extent of the body
 * @param origin of the body's centre relative to the centre of rotation (Stage's {@code origin})
 * @param startOdometry what odometry reports at the start: the zero pose in the classic dialect
 * @param sonar null if it has none
 * @param blobfinder null if it has none
 * @param rangers its lasers and rangers, in the order of the file
 * @param blocksRangers rays of others end at it
 * @param visible the blobfinders of others see it
 * @param blocksBodies if not, it drives through everything and everybody
 * @param drive how it moves
 * @param cargo what it carries
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
        SourcePosition where) {
    public RobotSpec {
        rangers = List.copyOf(rangers);
        cargo = List.copyOf(cargo);
    }

    /** A robot that blocks bodies, drives without limits and carries nothing. */
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
                where);
    }

    /** Everything of it that bumps into things: the body and what it carries. */
    public Shape collisionShape() {
        Shape whole = shape;
        for (CargoSpec piece : cargo) {
            whole = piece.blocksBodies() ? whole.with(piece.shape()) : whole;
        }
        return whole;
    }

    /** How wrong its odometry may be; {@link OdometryError#NONE} unless the file asks for it. */
    public OdometryError odometryError() {
        return switch (drive.localization()) {
            case DriveSpec.Localization.Gps gps -> OdometryError.NONE;
            case DriveSpec.Localization.DeadReckoning counted ->
                new OdometryError(counted.forward(), counted.sideways(), counted.turn());
        };
    }

    /** The same robot with odometry that adds up what the wheels do, and is wrong by this. */
    public RobotSpec withOdometryError(OdometryError error) {
        var counted = new DriveSpec.Localization.DeadReckoning(error.x(), error.y(), error.heading());
        return with(rangers, drive.withLocalization(counted));
    }

    /** The same robot with these lasers and rangers. */
    public RobotSpec withRangers(List<RangerSpec> others) {
        return with(others, drive);
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
                where);
    }
}
