package io.troupe.player;

import io.troupe.player.structures.PlayerPose3d;
import io.troupe.player.structures.sonar.PlayerSonarData;
import io.troupe.player.structures.sonar.PlayerSonarGeom;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import org.jspecify.annotations.Nullable;

/**
 * A ring of sonars.
 *
 * <p><b>Units and shapes.</b> Metres; one range per sonar, in the order of the geometry. Every message has an array of
 * its own, which may be changed.
 *
 * <p><b>Source.</b> Player interface sonar.
 */
public class SonarInterface extends PlayerDevice {
    private final Latest<PlayerSonarData> data = new Latest<>();
    private final Latest<PlayerSonarGeom> geometry = new Latest<>();

    public SonarInterface(PlayerClient client) {
        super(client);
    }

    /** The newest data, or null before there are any. */
    public @Nullable PlayerSonarData getData() {
        return data.get();
    }

    /** The answer to {@link #queryGeometry}, or null before. */
    public @Nullable PlayerSonarGeom getGeom() {
        return geometry.get();
    }

    /** True once for each new message. */
    public boolean isDataReady() {
        return pc.findsNews(data);
    }

    /** True once for each answer. */
    public boolean isGeomReady() {
        return pc.findsReply(geometry);
    }

    /** Asks where the sonars are; the answer is there when {@link #isGeomReady} is true. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    /**
     * Switches the sonars on (1) or off (0). Simulated ones cannot be switched off, as in Stage: that leaves a warning
     * in the log.
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
            var told = new PlayerSonarGeom();
            told.setPoses(poses);
            told.setPoses_count(poses.length);
            geometry.put(told);
        }
    }

    @Override
    Latest<?> latest() {
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
