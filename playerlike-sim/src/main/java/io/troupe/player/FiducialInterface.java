package io.troupe.player;

import io.troupe.player.structures.PlayerBbox2d;
import io.troupe.player.structures.fiducial.PlayerFiducialData;
import io.troupe.player.structures.fiducial.PlayerFiducialFov;
import io.troupe.player.structures.fiducial.PlayerFiducialGeom;
import io.troupe.player.structures.fiducial.PlayerFiducialItem;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A finder of fiducial markers: numbered marks on things and robots.
 *
 * {@snippet :
 * FiducialInterface finder = robot.requestInterfaceFiducial(0, PlayerConstants.PLAYER_OPEN_MODE);
 * while (!finder.isDataReady())
 *     ;
 * for (PlayerFiducialItem marker : finder.getData().getFiducials()) {
 *     log.add("marker " + marker.getId() + ", " + marker.getPose().getPx() + " m ahead");
 * }
 * }
 *
 * <p><b>Units and shapes.</b> Metres and radians. Poses are relative to the finder; number 0 means that the marker is
 * too far away for its number to be read. Every message has a separate copy of its array.
 *
 * <p><b>Source.</b> Player interface fiducial.
 */
public class FiducialInterface extends PlayerDevice {
    private final LatestValue<PlayerFiducialData> data = new LatestValue<>();
    private final LatestValue<PlayerFiducialGeom> geometry = new LatestValue<>();
    private final LatestValue<PlayerFiducialFov> fieldOfView = new LatestValue<>();
    private final LatestValue<Integer> ownMarker = new LatestValue<>();

    public FiducialInterface(PlayerClient client) {
        super(client);
    }

    /** The newest markers, or null before the first message. */
    public @Nullable PlayerFiducialData getData() {
        return data.get();
    }

    /** The newest reply to {@link #queryGeometry}, or null before the first. */
    public @Nullable PlayerFiducialGeom getGeom() {
        return geometry.get();
    }

    /** The newest reply to {@link #queryFOV} or {@link #setFov}, or null before the first. */
    public @Nullable PlayerFiducialFov getFOV() {
        return fieldOfView.get();
    }

    /** The newest reply to {@link #queryFiducialVal} or {@link #setFiducialVal}; 0 before the first. */
    public int getID() {
        Integer id = ownMarker.get();
        return id == null ? 0 : id;
    }

    /** True once for each new message with markers. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** True once for each reply to {@link #queryGeometry}. */
    public boolean isGeomReady() {
        return pc.hasReply(geometry);
    }

    /** True once for each reply to {@link #queryFOV} or {@link #setFov}. */
    public boolean isFOVReady() {
        return pc.hasReply(fieldOfView);
    }

    /** True once for each reply to {@link #queryFiducialVal} or {@link #setFiducialVal}. */
    public boolean isIDReady() {
        return pc.hasReply(ownMarker);
    }

    /** Requests the pose and size of the finder and the size of the markers. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    /** Requests the range and the angle in which markers are seen. */
    public void queryFOV() {
        ask(new DeviceRequest.GetFieldOfView());
    }

    /** Sets them; the reply contains what the server actually uses. */
    public void setFov(PlayerFiducialFov value) {
        ask(new DeviceRequest.SetFieldOfView(value.getMin_range(), value.getMax_range(), value.getView_angle()));
    }

    /** Requests the number of the marker that the robot itself has, which {@link #getID} returns then. */
    public void queryFiducialVal() {
        ask(new DeviceRequest.GetMarker());
    }

    /** Sets that number. A simulated robot refuses another one than that of the world file. */
    public void setFiducialVal(int id) {
        ask(new DeviceRequest.SetMarker(id));
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.Fiducials(List<DeviceData.Fiducial> seen)) {
            var newest = new PlayerFiducialData();
            newest.setFiducials(seen.stream().map(FiducialInterface::item).toArray(PlayerFiducialItem[]::new));
            newest.setFiducials_count(seen.size());
            data.put(newest);
        }
    }

    private static PlayerFiducialItem item(DeviceData.Fiducial marker) {
        var item = new PlayerFiducialItem();
        item.setId(marker.id());
        item.setPose(StructureConverter.pose(marker.pose()));
        item.setUpose(StructureConverter.pose(marker.uncertainty()));
        return item;
    }

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.FiducialGeometry finder) {
            var result = new PlayerFiducialGeom();
            result.setPose(StructureConverter.pose(finder.pose()));
            result.setSize(StructureConverter.box(finder.size()));
            var marker = new PlayerBbox2d();
            marker.setSw(finder.markerWidthM());
            marker.setSl(finder.markerLengthM());
            result.setFiducial_size(marker);
            geometry.put(result);
        } else if (reply instanceof DeviceReply.FieldOfView view) {
            var result = new PlayerFiducialFov();
            result.setMin_range(view.minRangeM());
            result.setMax_range(view.maxRangeM());
            result.setView_angle(view.angleRad());
            fieldOfView.put(result);
        } else if (reply instanceof DeviceReply.Marker(int id)) {
            ownMarker.put(id);
        }
    }
}
