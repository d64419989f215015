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
public class GripperInterface extends UnsupportedDevice {
    public GripperInterface(PlayerClient client) {
        super(client, "gripper");
    }

    public void open() {
        throw notSupported();
    }

    public void close() {
        throw notSupported();
    }

    public void stop() {
        throw notSupported();
    }

    public void store() {
        throw notSupported();
    }

    public void retrieve() {
        throw notSupported();
    }

    public void setGripper(int cmd) {
        throw notSupported();
    }

    public void queryGeometry() {
        throw notSupported();
    }

    public PlayerGripperData getData() {
        throw notSupported();
    }

    public PlayerGripperGeom getGeom() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }
}
