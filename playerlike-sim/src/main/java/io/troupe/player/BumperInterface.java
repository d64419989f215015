package io.troupe.player;

import io.troupe.player.structures.bumper.PlayerBumperData;
import io.troupe.player.structures.bumper.PlayerBumperDefine;
import io.troupe.player.structures.bumper.PlayerBumperGeom;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A row of bumpers.
 *
 * {@snippet :
 * BumperInterface bumpers = robot.requestInterfaceBumper(0, PlayerConstants.PLAYER_OPEN_MODE);
 * while (!bumpers.isDataReady())
 *     ;
 * boolean pressed = bumpers.getData().getBumpers()[0] != 0;
 * }
 *
 * <p><b>Units and shapes.</b> Metres and radians, in the robot's frame; a bumper that is pressed reads 1. Every message
 * has a separate copy of its array.
 *
 * <p><b>Source.</b> Player interface bumper.
 */
public class BumperInterface extends PlayerDevice {
    private final LatestValue<PlayerBumperData> data = new LatestValue<>();
    private final LatestValue<PlayerBumperGeom> geometry = new LatestValue<>();

    public BumperInterface(PlayerClient client) {
        super(client);
    }

    /** The newest states, or null before the first message. */
    public @Nullable PlayerBumperData getData() {
        return data.get();
    }

    /** The newest reply to {@link #queryGeometry}, or null before the first. */
    public @Nullable PlayerBumperGeom getGeom() {
        return geometry.get();
    }

    /** True once for each new message with states. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** True once for each reply to {@link #queryGeometry}. */
    public boolean isGeomReady() {
        return pc.hasReply(geometry);
    }

    /** Requests the poses and lengths of the bumpers. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.BumperStates(List<Byte> states)) {
            var bumpers = new byte[states.size()];
            for (int i = 0; i < bumpers.length; i++) {
                bumpers[i] = states.get(i);
            }
            var newest = new PlayerBumperData();
            newest.setBumpers(bumpers);
            newest.setBumpers_count(bumpers.length);
            data.put(newest);
        }
    }

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.BumperGeometry(List<DeviceReply.Bumper> bumpers)) {
            var result = new PlayerBumperGeom();
            result.setBumper_def(
                    bumpers.stream().map(BumperInterface::definition).toArray(PlayerBumperDefine[]::new));
            result.setBumper_def_count(bumpers.size());
            geometry.put(result);
        }
    }

    private static PlayerBumperDefine definition(DeviceReply.Bumper bumper) {
        var definition = new PlayerBumperDefine();
        definition.setPose(StructureConverter.pose(bumper.pose()));
        definition.setLength(bumper.lengthM());
        definition.setRadius(bumper.radiusM());
        return definition;
    }
}
