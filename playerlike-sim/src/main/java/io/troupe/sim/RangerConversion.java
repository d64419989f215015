package io.troupe.sim;

import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.LaserConfiguration;
import io.troupe.player.wire.Pose3d;
import io.troupe.player.wire.RangerConfiguration;
import io.troupe.player.wire.Size3d;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.SonarSpec;
import java.util.Collections;
import java.util.List;

/**
 * Converts laser and ranger readings and configurations to Player device data.
 *
 * <p>The resolution is the angle between two rays, so the last angle follows from the first angle and the number of
 * ranges. Stage divides the field of view by the number of rays, which is one too many. Range readings are not
 * quantised: as in Stage, the range resolution is 1 for a laser, and it is 0 for a ranger.
 */
final class RangerConversion {
    private static final float LASER_RANGE_RESOLUTION = 1;
    /** Relative tolerance. Clients round, and count either the beams or the steps between them. */
    private static final float ROUNDING = 0.01f;

    private RangerConversion() {}

    /** A sonar ring as a ranger with one sensor per sonar. */
    static RangerSpec ring(SonarSpec sonar) {
        return new RangerSpec(
                RangerSpec.Kind.RANGER,
                Pose.ORIGIN,
                0,
                0,
                sonar.mounts().stream()
                        .map(mount -> new RangeSensorSpec(
                                mount, sonar.minRangeM(), sonar.maxRangeM(), sonar.fovRad(), 1, 0, 0, RangeNoise.NONE))
                        .toList());
    }

    /**
     * True if a requested laser configuration equals the current one, but for intensities, which can be switched. Its
     * range resolution does not matter, nor its largest range: libplayerc has no value for it, and sends what happens
     * to be in its memory. A frequency of 0 means none, as in messages of javaclient3, which have no such field.
     */
    static boolean isSame(LaserConfiguration asked, LaserConfiguration real) {
        return isNear(asked.minAngleRad(), real.minAngleRad())
                && isNear(asked.maxAngleRad(), real.maxAngleRad())
                && isNear(asked.resolutionRad(), real.resolutionRad())
                && (asked.frequencyHz() == 0 || isNear(asked.frequencyHz(), real.frequencyHz()));
    }

    private static boolean isNear(float asked, float real) {
        return Math.abs(asked - real) <= ROUNDING * Math.abs(real);
    }

    /**
     * A scan always has an intensity for each range, as Stage's: libplayerc shows one for each, and playerprint printed
     * uninitialised memory where there was none. They are 0 if they are not measured.
     */
    static DeviceData scan(RangerSpec laser, List<Double> rangesM, List<Double> intensities, long tick) {
        RangeSensorSpec sensor = laser.sensors().getFirst();
        return new DeviceData.LaserScan(
                (float) (-sensor.fovRad() / 2),
                (float) (sensor.fovRad() / 2),
                (float) resolutionRad(sensor),
                (float) sensor.maxRangeM(),
                rangesM.stream().map(Double::floatValue).toList(),
                intensities.isEmpty()
                        ? Collections.nCopies(rangesM.size(), (byte) 0)
                        : intensities.stream().map(RangerConversion::octet).toList(),
                (int) tick);
    }

    private static byte octet(double intensity) {
        return (byte) Math.clamp(Math.round(intensity), 0, 255);
    }

    static DeviceReply laserGeometry(RangerSpec laser) {
        return new DeviceReply.LaserGeometry(flat(laser.mount()), new Size3d(laser.widthM(), laser.lengthM(), 0));
    }

    /** Geometry of a ranger. The poses of its sensors are relative to the ranger's pose. */
    static DeviceReply rangerGeometry(RangerSpec ranger) {
        return new DeviceReply.RangerGeometry(
                flat(ranger.mount()),
                new Size3d(ranger.widthM(), ranger.lengthM(), 0),
                ranger.sensors().stream()
                        .map(sensor -> flat(seenFrom(ranger.mount(), sensor.mount())))
                        .toList(),
                ranger.sensors().stream()
                        .map(sensor -> new Size3d(sensor.widthM(), sensor.lengthM(), 0))
                        .toList());
    }

    static LaserConfiguration laserConfiguration(RangerSpec laser, int intervalMillis, boolean intensities) {
        RangeSensorSpec sensor = laser.sensors().getFirst();
        return new LaserConfiguration(
                (float) (-sensor.fovRad() / 2),
                (float) (sensor.fovRad() / 2),
                (float) resolutionRad(sensor),
                (float) sensor.maxRangeM(),
                LASER_RANGE_RESOLUTION,
                intensities,
                1000f / intervalMillis);
    }

    /** Configuration of the first sensor: Player has one configuration for all sensors of a ranger. */
    static RangerConfiguration rangerConfiguration(RangerSpec ranger, int intervalMillis) {
        RangeSensorSpec sensor = ranger.sensors().getFirst();
        return new RangerConfiguration(
                -sensor.fovRad() / 2,
                sensor.fovRad() / 2,
                resolutionRad(sensor),
                sensor.minRangeM(),
                sensor.maxRangeM(),
                0,
                1000.0 / intervalMillis);
    }

    private static double resolutionRad(RangeSensorSpec sensor) {
        return sensor.samples() == 1 ? sensor.fovRad() : sensor.fovRad() / (sensor.samples() - 1);
    }

    private static Pose seenFrom(Pose frame, Pose pose) {
        return new Pose(0, 0, -frame.headingRad())
                .compose(new Pose(pose.x() - frame.x(), pose.y() - frame.y(), pose.headingRad()));
    }

    private static Pose3d flat(Pose pose) {
        return Pose3d.flat(pose.x(), pose.y(), pose.headingRad());
    }
}
