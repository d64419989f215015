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
 * <p><b>Units and shapes.</b> Metres; one range per sonar, in the order of the geometry. Every message has an array of its own, which may be changed.
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
        return geometry.takeNew();
    }

    /** Asks where the sonars are. */
    public void queryGeometry() {
        if (ask(new DeviceRequest.Geometry()) instanceof DeviceReply.SonarGeometry reply) {
            var poses = new PlayerPose3d[reply.mounts().size()];
            for (int sonar = 0; sonar < poses.length; sonar++) {
                var mount = reply.mounts().get(sonar);
                poses[sonar] = new PlayerPose3d();
                poses[sonar].setPx(mount.px());
                poses[sonar].setPy(mount.py());
                poses[sonar].setPyaw(mount.yaw());
            }
            var answer = new PlayerSonarGeom();
            answer.setPoses(poses);
            answer.setPoses_count(poses.length);
            geometry.put(answer);
        }
    }

    /** Switches the sonars on (1) or off (0); simulated ones are always on and refuse the latter. */
    public void setSonarPower(int state) {
        ask(new DeviceRequest.Power(state != 0));
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
