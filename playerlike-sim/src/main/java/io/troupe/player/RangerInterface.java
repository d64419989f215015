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
 * <p><b>Units and shapes.</b> Metres and radians. The ranges of all elements one after the other; within an element
 * from right to left. Every message has a separate copy of its array, which the program may change.
 *
 * <p><b>Source.</b> Player interface ranger.
 */
public class RangerInterface extends PlayerDevice {
    private final Latest<PlayerRangerData> data = new Latest<>();
    private final Latest<PlayerRangerDataIntns> intensities = new Latest<>();
    private final Latest<PlayerRangerGeom> geometry = new Latest<>();
    private final Latest<PlayerRangerConf> configuration = new Latest<>();

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
        return pc.findsNews(data);
    }

    /** True once for each new message with intensities. */
    public boolean isDataIntnsReady() {
        return pc.findsReply(intensities);
    }

    /** True once for each reply to {@link #queryGeometry}. */
    public boolean isGeomReady() {
        return pc.findsReply(geometry);
    }

    /** True once for each reply to {@link #queryConfiguration}. */
    public boolean isConfReady() {
        return pc.findsReply(configuration);
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
    Latest<?> latest() {
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
            var told = new PlayerRangerGeom();
            told.setPose(Shapes.pose(where.pose()));
            told.setSize(Shapes.box(where.size()));
            told.setPoses(where.elementPoses().stream().map(Shapes::pose).toArray(PlayerPose3d[]::new));
            told.setPoses_count(where.elementPoses().size());
            told.setSizes(where.elementSizes().stream().map(Shapes::box).toArray(PlayerBbox3d[]::new));
            told.setSizes_count(where.elementSizes().size());
            geometry.put(told);
        } else if (reply instanceof DeviceReply.OfRanger(RangerConfiguration how)) {
            var told = new PlayerRangerConf();
            told.setMin_angle(how.minAngleRad());
            told.setMax_angle(how.maxAngleRad());
            told.setResolution(how.resolutionRad());
            told.setMin_range(how.minRangeM());
            told.setMax_range(how.maxRangeM());
            told.setRange_res(how.rangeResolutionM());
            told.setFrequency(how.frequencyHz());
            configuration.put(told);
        }
    }
}
