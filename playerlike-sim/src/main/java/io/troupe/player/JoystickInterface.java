package io.troupe.player;

import io.troupe.player.structures.joystick.PlayerJoystickData;

/**
 * A joystick, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface joystick.
 */
public class JoystickInterface extends UnofferedDevice {
    public JoystickInterface(PlayerClient client) {
        super(client, "joystick");
    }

    public PlayerJoystickData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
