package io.troupe.player;

/**
 * An inertial sensor, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface imu.
 */
public class IMUInterface extends UnofferedDevice {
    public IMUInterface(PlayerClient client) {
        super(client, "imu");
    }
}
