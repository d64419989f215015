package io.troupe.player;

import io.troupe.player.structures.joystick.PlayerJoystickData;

/**
 * A joystick. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface joystick.
 */
public class JoystickInterface extends UnsupportedDevice {
    public JoystickInterface(PlayerClient client) {
        super(client, "joystick");
    }

    public PlayerJoystickData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
