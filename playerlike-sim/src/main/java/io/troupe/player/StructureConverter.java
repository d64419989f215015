package io.troupe.player;

import io.troupe.player.structures.PlayerBbox3d;
import io.troupe.player.structures.PlayerPose3d;
import io.troupe.player.wire.Pose3d;
import io.troupe.player.wire.Size3d;

/** Converts poses and sizes of the wire protocol to the client's structures. */
final class StructureConverter {
    private StructureConverter() {}

    static PlayerPose3d pose(Pose3d pose) {
        var converted = new PlayerPose3d();
        converted.setPx(pose.x());
        converted.setPy(pose.y());
        converted.setPz(pose.z());
        converted.setProll(pose.roll());
        converted.setPpitch(pose.pitch());
        converted.setPyaw(pose.yaw());
        return converted;
    }

    static PlayerBbox3d box(Size3d size) {
        var converted = new PlayerBbox3d();
        converted.setSw(size.widthM());
        converted.setSl(size.lengthM());
        converted.setSh(size.heightM());
        return converted;
    }
}
