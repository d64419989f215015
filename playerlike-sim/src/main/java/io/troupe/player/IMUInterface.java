package io.troupe.player;

/**
 * An inertial sensor. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface imu.
 */
public class IMUInterface extends UnsupportedDevice {
    public IMUInterface(PlayerClient client) {
        super(client, "imu");
    }
}
