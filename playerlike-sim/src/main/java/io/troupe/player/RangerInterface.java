package io.troupe.player;

import io.troupe.player.structures.PlayerBbox3d;
import io.troupe.player.structures.PlayerPose3d;
import io.troupe.player.structures.ranger.PlayerRangerConf;
import io.troupe.player.structures.ranger.PlayerRangerData;
import io.troupe.player.structures.ranger.PlayerRangerDataIntns;
import io.troupe.player.structures.ranger.PlayerRangerGeom;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.RangerConfiguration;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A range sensor with one element (a scanning laser) or several (a sonar ring).
 *
 * {@snippet :
 * RangerInterface ranger = robot.requestInterfaceRanger(0, PlayerConstants.PLAYER_OPEN_MODE);
 * while (!ranger.isDataReady())
 *     ;
 * double[] ranges = ranger.getData().getRanges();
 * }
 *
 * <p><b>Units and shapes.</b> Metres and radians. The ranges of all elements one after the other; within an element
 * from right to left. Every message has a separate copy of its array, which the program may change.
 *
 * <p><b>Source.</b> Player interface ranger.
 */
public class RangerInterface extends PlayerDevice {
    private final LatestValue<PlayerRangerData> data = new LatestValue<>();
    private final LatestValue<PlayerRangerDataIntns> intensities = new LatestValue<>();
    private final LatestValue<PlayerRangerGeom> geometry = new LatestValue<>();
    private final LatestValue<PlayerRangerConf> configuration = new LatestValue<>();

    public RangerInterface(PlayerClient client) {
        super(client);
    }

    /** The newest ranges, or null before the first. */
    public @Nullable PlayerRangerData getData() {
        return data.get();
    }

    /** The newest intensities, or null before the first. Simulated rangers send none. */
    public @Nullable PlayerRangerDataIntns getDataIntns() {
        return intensities.get();
    }

    /** The newest reply to {@link #queryGeometry}, or null before the first. */
    public @Nullable PlayerRangerGeom getGeom() {
        return geometry.get();
    }

    /** The newest reply to {@link #queryConfiguration}, or null before the first. */
    public @Nullable PlayerRangerConf getConf() {
        return configuration.get();
    }

    /** True once for each new message with ranges. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** True once for each new message with intensities. */
    public boolean isDataIntnsReady() {
        return pc.hasReply(intensities);
    }

    /** True once for each reply to {@link #queryGeometry}. */
    public boolean isGeomReady() {
        return pc.hasReply(geometry);
    }

    /** True once for each reply to {@link #queryConfiguration}. */
    public boolean isConfReady() {
        return pc.hasReply(configuration);
    }

    /** Requests the poses and sizes of the ranger and its elements. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    /** Requests the scan configuration. */
    public void queryConfiguration() {
        ask(new DeviceRequest.GetConfiguration());
    }

    /** Switches the ranger on (1) or off (0). */
    public void setRangerPower(int state) {
        ask(new DeviceRequest.Power(state != 0));
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        switch (message) {
            case DeviceData.RangerRanges scan -> {
                var newest = new PlayerRangerData();
                newest.setRanges(array(scan.rangesM()));
                newest.setRanges_count(scan.rangesM().size());
                data.put(newest);
            }
            case DeviceData.RangerIntensities scan -> {
                var newest = new PlayerRangerDataIntns();
                newest.setIntens(array(scan.intensities()));
                newest.setIntns_count(scan.intensities().size());
                intensities.put(newest);
            }
            case DeviceData.RangerStamped stamped -> {
                if (stamped.geometry() != null) {
                    accept(stamped.geometry());
                }
                if (stamped.configuration() != null) {
                    accept(new DeviceReply.OfRanger(stamped.configuration()));
                }
                accept(stamped.data());
            }
            default -> {} // not ranger data
        }
    }

    private static double[] array(List<Double> values) {
        return values.stream().mapToDouble(Double::doubleValue).toArray();
    }

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.RangerGeometry where) {
            var result = new PlayerRangerGeom();
            result.setPose(StructureConverter.pose(where.pose()));
            result.setSize(StructureConverter.box(where.size()));
            result.setPoses(
                    where.elementPoses().stream().map(StructureConverter::pose).toArray(PlayerPose3d[]::new));
            result.setPoses_count(where.elementPoses().size());
            result.setSizes(
                    where.elementSizes().stream().map(StructureConverter::box).toArray(PlayerBbox3d[]::new));
            result.setSizes_count(where.elementSizes().size());
            geometry.put(result);
        } else if (reply instanceof DeviceReply.OfRanger(RangerConfiguration how)) {
            var result = new PlayerRangerConf();
            result.setMin_angle(how.minAngleRad());
            result.setMax_angle(how.maxAngleRad());
            result.setResolution(how.resolutionRad());
            result.setMin_range(how.minRangeM());
            result.setMax_range(how.maxRangeM());
            result.setRange_res(how.rangeResolutionM());
            result.setFrequency(how.frequencyHz());
            configuration.put(result);
        }
    }
}
