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
 * @param odometryError how wrong its odometry may be; {@link OdometryError#NONE} unless the file asks for it
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
        SourcePosition where,
        OdometryError odometryError) {
    public RobotSpec {
        rangers = List.copyOf(rangers);
    }

    /** With exact odometry. */
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
                where,
                OdometryError.NONE);
    }

    /** The same robot with other odometry. */
    public RobotSpec withOdometryError(OdometryError error) {
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
                blocksRangers,
                visible,
                where,
                error);
    }

    /** The same robot with these lasers and rangers. */
    public RobotSpec withRangers(List<RangerSpec> others) {
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
                others,
                blocksRangers,
                visible,
                where,
                odometryError);
    }
}
