package io.troupe.player;

import io.troupe.player.structures.PlayerPose3d;
import io.troupe.player.structures.sonar.PlayerSonarData;
import io.troupe.player.structures.sonar.PlayerSonarGeom;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import org.jspecify.annotations.Nullable;

/**
 * A sonar ring.
 *
 * {@snippet :
 * SonarInterface sonar = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
 * while (!sonar.isDataReady())
 *     ;
 * float[] ranges = sonar.getData().getRanges();
 * }
 *
 * <p><b>Units and shapes.</b> Metres; one range per sonar, in the order of the geometry. Every message has a separate
 * copy of its array, which the program may change.
 *
 * <p><b>Source.</b> Player interface sonar.
 */
public class SonarInterface extends PlayerDevice {
    private final LatestValue<PlayerSonarData> data = new LatestValue<>();
    private final LatestValue<PlayerSonarGeom> geometry = new LatestValue<>();

    public SonarInterface(PlayerClient client) {
        super(client);
    }

    /** The newest data, or null before the first message. */
    public @Nullable PlayerSonarData getData() {
        return data.get();
    }

    /** The newest reply to {@link #queryGeometry}, or null before the first. */
    public @Nullable PlayerSonarGeom getGeom() {
        return geometry.get();
    }

    /** True once for each new message. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** True once for each reply. */
    public boolean isGeomReady() {
        return pc.hasReply(geometry);
    }

    /** Requests the poses of the sonars; {@link #isGeomReady} is true when the reply has arrived. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    /**
     * Switches the sonars on (1) or off (0). Simulated sonars cannot be switched off, as in Stage: that logs a warning.
     */
    public void setSonarPower(int state) {
        ask(new DeviceRequest.Power(state != 0));
    }

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.SonarGeometry ring) {
            var poses = new PlayerPose3d[ring.mounts().size()];
            for (int sonar = 0; sonar < poses.length; sonar++) {
                var mount = ring.mounts().get(sonar);
                poses[sonar] = new PlayerPose3d();
                poses[sonar].setPx(mount.px());
                poses[sonar].setPy(mount.py());
                poses[sonar].setPyaw(mount.yaw());
            }
            var result = new PlayerSonarGeom();
            result.setPoses(poses);
            result.setPoses_count(poses.length);
            geometry.put(result);
        }
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.SonarRanges sonar) {
            var ranges = new float[sonar.rangesM().size()];
            for (int index = 0; index < ranges.length; index++) {
                ranges[index] = sonar.rangesM().get(index);
            }
            var newest = new PlayerSonarData();
            newest.setRanges(ranges);
            newest.setRanges_count(ranges.length);
            data.put(newest);
        }
    }
}
