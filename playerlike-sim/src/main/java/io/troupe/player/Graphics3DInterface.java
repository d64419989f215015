package io.troupe.player;

import io.troupe.player.structures.graphics3d.PlayerGraphics3dCmdDraw;

/**
 * 3D graphics. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface graphics3d.
 */
public class Graphics3DInterface extends UnsupportedDevice {
    public Graphics3DInterface(PlayerClient client) {
        super(client, "graphics3d");
    }

    public void clearScreen() {
        throw notSupported();
    }

    public void draw(PlayerGraphics3dCmdDraw value) {
        throw notSupported();
    }
}
