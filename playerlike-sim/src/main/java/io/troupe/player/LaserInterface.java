package io.troupe.player;

import io.troupe.player.structures.PlayerPoint2d;
import io.troupe.player.structures.laser.PlayerLaserConfig;
import io.troupe.player.structures.laser.PlayerLaserData;
import io.troupe.player.structures.laser.PlayerLaserDataScanpose;
import io.troupe.player.structures.laser.PlayerLaserGeom;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.LaserConfiguration;
import org.jspecify.annotations.Nullable;

/**
 * A scanning laser.
 *
 * {@snippet :
 * LaserInterface laser = robot.requestInterfaceLaser(0, PlayerConstants.PLAYER_OPEN_MODE);
 * while (!laser.isDataReady())
 *     ;
 * float[] ranges = laser.getData().getRanges();
 * float leastAngle = laser.getData().getMin_angle();
 * }
 *
 * <p><b>Units and shapes.</b> Metres and radians; a scan runs from the least angle (right) to the greatest (left).
 * Every message has a separate copy of its arrays, which the program may change.
 *
 * <p><b>Source.</b> Player interface laser.
 */
public class LaserInterface extends PlayerDevice {
    private final LatestValue<PlayerLaserData> data = new LatestValue<>();
    private final LatestValue<PlayerLaserDataScanpose> scanPose = new LatestValue<>();
    private final LatestValue<PlayerLaserGeom> geometry = new LatestValue<>();
    private final LatestValue<PlayerLaserConfig> configuration = new LatestValue<>();

    public LaserInterface(PlayerClient client) {
        super(client);
    }

    /** The newest scan, or null before the first. */
    public @Nullable PlayerLaserData getData() {
        return data.get();
    }

    /** The newest scan with the robot's pose, or null before the first. Simulated lasers send scans without poses. */
    public @Nullable PlayerLaserDataScanpose getDataScanPose() {
        return scanPose.get();
    }

    /** The newest reply to {@link #queryGeometry}, or null before the first. */
    public @Nullable PlayerLaserGeom getPlayerLaserGeom() {
        return geometry.get();
    }

    /** The newest reply to {@link #getScanProperties}, or null before the first. */
    public @Nullable PlayerLaserConfig getPlayerLaserConfig() {
        return configuration.get();
    }

    /** True once for each new scan. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** True once for each new scan with the robot's pose. */
    public boolean isDataScanposeReady() {
        return pc.hasReply(scanPose);
    }

    /** True once for each reply to {@link #queryGeometry}. */
    public boolean isReadyPlgeom() {
        return pc.hasReply(geometry);
    }

    /** True once for each reply to {@link #getScanProperties}. */
    public boolean isReadyPlconfig() {
        return pc.hasReply(configuration);
    }

    /** Requests the pose and size of the laser. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    /** Requests the scan configuration; {@link #isReadyPlconfig} is true when the reply has arrived. */
    public void getScanProperties() {
        ask(new DeviceRequest.GetConfiguration());
    }

    /** Sets the scan configuration; the reply contains the one that the server actually uses. */
    public void setScanProperties(PlayerLaserConfig config) {
        ask(new DeviceRequest.SetLaserConfiguration(new LaserConfiguration(
                config.getMin_angle(),
                config.getMax_angle(),
                config.getResolution(),
                config.getMax_range(),
                config.getRange_res(),
                config.getIntensity() != 0,
                config.getScanning_frequency())));
    }

    /** Switches the laser on (1) or off (0). */
    public void setPower(int state) {
        ask(new DeviceRequest.Power(state != 0));
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.LaserScan scan) {
            var newest = new PlayerLaserData();
            newest.setMin_angle(scan.minAngleRad());
            newest.setMax_angle(scan.maxAngleRad());
            newest.setResolution(scan.resolutionRad());
            newest.setMax_range(scan.maxRangeM());
            int count = scan.rangesM().size();
            var ranges = new float[count];
            var points = new PlayerPoint2d[count];
            for (int beam = 0; beam < count; beam++) {
                ranges[beam] = scan.rangesM().get(beam);
                double angle = scan.minAngleRad() + beam * (double) scan.resolutionRad();
                points[beam] =
                        new PlayerPoint2d(ranges[beam] * StrictMath.cos(angle), ranges[beam] * StrictMath.sin(angle));
            }
            newest.setRanges(ranges);
            newest.setRanges_count(count);
            newest.setPoints(points);
            var intensity = new byte[scan.intensities().size()];
            for (int beam = 0; beam < intensity.length; beam++) {
                intensity[beam] = scan.intensities().get(beam);
            }
            newest.setIntensity(intensity);
            newest.setIntensity_count(intensity.length);
            newest.setId(scan.scanId());
            data.put(newest);
        }
    }

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.LaserGeometry where) {
            var result = new PlayerLaserGeom();
            result.setPose(StructureConverter.pose(where.pose()));
            result.setSize(StructureConverter.box(where.size()));
            geometry.put(result);
        } else if (reply instanceof DeviceReply.OfLaser(LaserConfiguration how)) {
            var result = new PlayerLaserConfig();
            result.setMin_angle(how.minAngleRad());
            result.setMax_angle(how.maxAngleRad());
            result.setResolution(how.resolutionRad());
            result.setMax_range(how.maxRangeM());
            result.setRange_res(how.rangeResolutionM());
            result.setIntensity((byte) (how.intensities() ? 1 : 0));
            result.setScanning_frequency(how.frequencyHz());
            configuration.put(result);
        }
    }
}
