package io.troupe.player;

import io.troupe.player.structures.gripper.PlayerGripperData;
import io.troupe.player.structures.gripper.PlayerGripperGeom;

/**
 * A gripper. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface gripper.
 */
public class GripperInterface extends UnofferedDevice {
    public GripperInterface(PlayerClient client) {
        super(client, "gripper");
    }

    public void open() {
        throw notOffered();
    }

    public void close() {
        throw notOffered();
    }

    public void stop() {
        throw notOffered();
    }

    public void store() {
        throw notOffered();
    }

    public void retrieve() {
        throw notOffered();
    }

    public void setGripper(int cmd) {
        throw notOffered();
    }

    public void queryGeometry() {
        throw notOffered();
    }

    public PlayerGripperData getData() {
        throw notOffered();
    }

    public PlayerGripperGeom getGeom() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }
}
